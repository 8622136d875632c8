//! The sums over neighbours of the small loop.

use super::Block;
use crate::study::tensile::case::Form;
use crate::study::tensile::partition::Equation;
use glam::{DMat3, DVec3};
use rayon::prelude::*;

impl Block {
    fn pressure(&self, a: usize) -> f64 {
        self.density[a] - 1.0
    }

    /// R_a, negative where it repels.
    fn repulsive(&self, a: usize) -> f64 {
        let (pressure, square) = (self.pressure(a), self.density[a].powi(2));
        let part = self.case.epsilon * pressure / square;
        match self.case.form {
            Form::Signed => part,
            Form::Opposed => -part,
            _ if pressure >= 0.0 => 0.0,
            Form::Trace => 3.0 * part,
            // A fluid's principal stresses are all -P.
            Form::Pressure | Form::Principal => part,
        }
    }

    /// Estimates of unity, where a partition asks for them.
    pub(super) fn unity(&self) -> Option<Vec<f64>> {
        let partition = self.rule.partition?;
        let lattice = self.case.lattice();
        let of = |a: usize| {
            let term = |b: usize, r: f64| self.mass / self.density[b] * partition.unity_term(&lattice, r);
            let others = self.lists[a].iter().map(|&b| b as usize);
            term(a, 0.0) + others.map(|b| term(b, self.position[a].distance(self.position[b]))).sum::<f64>()
        };
        Some((0..self.position.len()).into_par_iter().map(of).collect())
    }

    /// dW/dr of particle a's sums in one of the equations.
    pub(super) fn slope(&self, equation: Equation, unity: Option<f64>, r: f64) -> f64 {
        let lattice = self.case.lattice();
        match (self.rule.partition, unity) {
            (Some(partition), Some(unity)) if partition.equation == equation => partition.slope(&lattice, unity, r),
            _ => lattice.smoothing.derivative(r, lattice.smoothing_length, lattice.dimension),
        }
    }

    pub(super) fn accelerate(&mut self) {
        self.list();
        let sums: Vec<(DVec3, DVec3)> = if self.rule.lagrangian {
            self.lagrangian_accelerations().into_iter().map(|a| (a, DVec3::ZERO)).collect()
        } else {
            let unity = self.unity();
            (0..self.position.len()).into_par_iter().map(|a| self.eulerian(a, unity.as_ref().map(|u| u[a]))).collect()
        };
        (self.acceleration, self.repulsion) = sums.into_iter().unzip();
    }

    /// Acceleration of particle a, and the repulsive force's share.
    fn eulerian(&self, a: usize, unity: Option<f64>) -> (DVec3, DVec3) {
        let lattice = self.case.lattice();
        let (h, dimension) = (lattice.smoothing_length, lattice.dimension);
        let specific = |b: usize| self.pressure(b) / self.density[b].powi(2);
        let whole = if self.case.epsilon == 0.0 { 1.0 } else { lattice.smoothing.value(self.case.dp(), h, dimension) };
        let (own, own_repulsive) = (specific(a), self.repulsive(a));
        let (mut sum, mut repulsion) = (DVec3::ZERO, DVec3::ZERO);
        for &b in &self.lists[a] {
            let b = b as usize;
            let x = self.position[a] - self.position[b];
            let r = x.length();
            let away = x / r;
            let slope = self.slope(Equation::Momentum, unity, r);
            sum -= away * (self.mass * (own + specific(b) + self.viscous(a, b, x)) * slope);
            if self.case.epsilon != 0.0 && r < 2.0 * h {
                let f = (lattice.smoothing.value(r, h, dimension) / whole).powf(self.case.exponent);
                repulsion += away * (self.mass * (own_repulsive + self.repulsive(b)) * f * slope);
            }
        }
        (sum + repulsion, repulsion)
    }

    /// Pi_ab.
    fn viscous(&self, a: usize, b: usize, x: DVec3) -> f64 {
        let Some([linear, quadratic, softening]) = self.rule.viscosity else { return 0.0 };
        let approach = (self.velocity[a] - self.velocity[b]).dot(x);
        if approach >= 0.0 {
            return 0.0;
        }
        let h = self.case.ratio;
        let mu = h * approach / (x.length_squared() + softening * h * h);
        (linear * mu.abs() + quadratic * mu * mu) / (0.5 * (self.density[a] + self.density[b]))
    }

    fn lagrangian_accelerations(&self) -> Vec<DVec3> {
        let lattice = self.case.lattice();
        let gradient = |a: usize, b: usize| {
            let x = self.start[a] - self.start[b];
            x * (lattice.smoothing.derivative(x.length(), lattice.smoothing_length, lattice.dimension) / x.length())
        };
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        // As if the block lay in a lattice without end that is held: F = 1 + sum (u_b - u_a) (x) g/kappa.
        let kappa = -self
            .case
            .distances()
            .iter()
            .map(|r| r * lattice.smoothing.derivative(*r, lattice.smoothing_length, lattice.dimension))
            .sum::<f64>()
            / lattice.dimension as f64;
        let displacement = |a: usize| self.position[a] - self.start[a];
        // The nominal stress J sigma F^-T.
        let nominal = |a: usize| {
            let term = |&b: &u32| outer(displacement(b as usize) - displacement(a), gradient(a, b as usize));
            let f = DMat3::IDENTITY + self.lists[a].iter().map(term).sum::<DMat3>() * (1.0 / kappa);
            let volume = f.determinant();
            let pressure = 1.0 / (self.case.volume * volume) - 1.0;
            f.inverse().transpose() * (-pressure * volume)
        };
        let stress: Vec<DMat3> = (0..self.start.len()).into_par_iter().map(nominal).collect();
        let square = self.mass * self.mass;
        let of = |a: usize| {
            let force = |b: usize| (stress[a] + stress[b]) * gradient(a, b) * (self.mass / (square * kappa));
            self.lists[a].iter().map(|&b| force(b as usize)).sum()
        };
        (0..self.start.len()).into_par_iter().map(of).collect()
    }
}
