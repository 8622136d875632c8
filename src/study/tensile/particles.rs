//! Swegle's test as a small loop over particles, for what no pass of the program does: the work of the repulsive force,
//! partitions of unity, a repulsive force in compression. Fluid only, in units of the spacing and the speed of sound.
//!
//! The equations are those of the passes (density by continuity, leapfrog with the strain rate at the half step), so
//! that without those additions it follows a run of the program.

use super::case::{Case, Form};
use super::partition::{Equation, Partition};
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// What is added to the plain method, besides the case's repulsive force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rule {
    /// Bond viscosity of particles that approach: C_L, C_Q and the softening epsilon_0 (Johnson 1996).
    pub viscosity: Option<[f64; 3]>,
    pub partition: Option<Partition>,
    /// Kernels of the reference positions and the nominal stress instead (Total Lagrangian).
    pub lagrangian: bool,
}

/// Sums of one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// In dx/c.
    pub time: f64,
    /// Root mean square speed, in c: the thesis's total velocity.
    pub speed: f64,
    /// Kinetic energy, in rho0 c^2 dx^D.
    pub kinetic: f64,
    /// Work of the repulsive force along the way so far, the same unit.
    pub work: f64,
    /// The same as the thesis sums it: length of the force times length of the step.
    pub work_of_lengths: f64,
}

/// A block of particles whose border, as wide as the kernel reaches, is held.
pub struct Block {
    case: Case,
    rule: Rule,
    mass: f64,
    start: Vec<DVec3>,
    pub position: Vec<DVec3>,
    pub velocity: Vec<DVec3>,
    density: Vec<f64>,
    held: Vec<bool>,
    acceleration: Vec<DVec3>,
    /// The repulsive force's share of the acceleration.
    pub repulsion: Vec<DVec3>,
    lists: Vec<Vec<u32>>,
    /// Positions of which the lists were made.
    listed: Vec<DVec3>,
    time: f64,
    work: f64,
    work_of_lengths: f64,
}

/// By how much lists reach beyond the kernel, in spacings.
const MARGIN: f64 = 0.5;

/// How far sums reach.
fn reach(case: Case, rule: Rule) -> f64 {
    2.0 * case.ratio * rule.partition.map_or(1.0, |partition| partition.scale.max(1.0))
}

/// Layers that are held on each side.
pub fn border(case: Case, rule: Rule) -> usize {
    reach(case, rule).ceil() as usize
}

impl Block {
    /// `side` particles along each axis, an odd number; the one in the middle is kicked along x by `kick` (in c).
    pub fn new(case: Case, rule: Rule, side: usize, kick: f64) -> Self {
        let along = |axis: usize| if axis < case.dimension { 0..side } else { 0..1 };
        let point = |x: usize, y: usize, z: usize| DVec3::new(x as f64, y as f64, z as f64);
        let start: Vec<DVec3> =
            along(0).flat_map(|x| along(1).flat_map(move |y| along(2).map(move |z| point(x, y, z)))).collect();
        let border = border(case, rule) as f64;
        let inner = border..=(side as f64 - 1.0 - border);
        let held = start.iter().map(|x| (0..case.dimension).any(|axis| !inner.contains(&x[axis]))).collect();
        let mut velocity = vec![DVec3::ZERO; start.len()];
        velocity[start.len() / 2].x = kick;
        let mut block = Self {
            case,
            rule,
            mass: 1.0 / case.volume,
            position: start.clone(),
            velocity,
            density: vec![1.0 / case.volume; start.len()],
            held,
            acceleration: Vec::new(),
            repulsion: Vec::new(),
            lists: Vec::new(),
            listed: Vec::new(),
            start,
            time: 0.0,
            work: 0.0,
            work_of_lengths: 0.0,
        };
        block.accelerate();
        block
    }

    /// Gives the free particles of a line the velocity of a standing wave, m half waves long, instead of a kick.
    #[must_use]
    pub fn standing(mut self, m: usize, amplitude: f64) -> Self {
        let border = border(self.case, self.rule);
        let free = self.start.len() - 2 * border;
        for a in 0..self.start.len() {
            let phase = PI * m as f64 * (self.start[a].x + 1.0 - border as f64) / (free + 1) as f64;
            self.velocity[a] = if self.held[a] { DVec3::ZERO } else { DVec3::X * (amplitude * phase.sin()) };
        }
        self
    }

    fn list(&mut self) {
        let moved = |(now, then): (&DVec3, &DVec3)| now.distance_squared(*then) > (0.5 * MARGIN).powi(2);
        if !self.listed.is_empty() && !self.position.iter().zip(&self.listed).any(moved) {
            return;
        }
        let (position, reach) = (&self.position, (reach(self.case, self.rule) + MARGIN).powi(2));
        let near = |a: usize| {
            let others = (0..position.len() as u32).filter(move |&b| b as usize != a);
            others.filter(|&b| position[a].distance_squared(position[b as usize]) < reach).collect()
        };
        self.lists = (0..position.len()).into_par_iter().map(near).collect();
        self.listed = position.clone();
    }

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
    fn unity(&self) -> Option<Vec<f64>> {
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
    fn slope(&self, equation: Equation, unity: Option<f64>, r: f64) -> f64 {
        let lattice = self.case.lattice();
        match (self.rule.partition, unity) {
            (Some(partition), Some(unity)) if partition.equation == equation => partition.slope(&lattice, unity, r),
            _ => lattice.smoothing.derivative(r, lattice.smoothing_length, lattice.dimension),
        }
    }

    fn accelerate(&mut self) {
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

    fn kick(&mut self, dt: f64) {
        for a in (0..self.velocity.len()).filter(|&a| !self.held[a]) {
            self.velocity[a] += self.acceleration[a] * dt;
        }
    }

    fn drift(&mut self, dt: f64) {
        for a in 0..self.position.len() {
            self.position[a] += self.velocity[a] * dt;
        }
    }

    fn strain(&mut self, dt: f64) {
        if self.rule.lagrangian {
            return;
        }
        self.list();
        let unity = self.unity();
        let divergence = |a: usize| -> f64 {
            let term = |b: usize| {
                let x = self.position[a] - self.position[b];
                let r = x.length();
                let slope = self.slope(Equation::StrainRate, unity.as_ref().map(|u| u[a]), r);
                self.mass / self.density[b] * (self.velocity[b] - self.velocity[a]).dot(x / r) * slope
            };
            self.lists[a].iter().map(|&b| term(b as usize)).sum()
        };
        let rates: Vec<f64> = (0..self.position.len()).into_par_iter().map(divergence).collect();
        for (density, rate) in self.density.iter_mut().zip(rates) {
            // Exact for a constant rate, as the volume of the pass.
            *density *= (-rate * dt).exp();
        }
    }

    /// One step of leapfrog.
    pub fn step(&mut self, dt: f64) {
        let (before, force) = (self.position.clone(), self.repulsion.clone());
        self.kick(0.5 * dt);
        self.drift(0.5 * dt);
        self.strain(dt);
        self.drift(0.5 * dt);
        self.accelerate();
        self.kick(0.5 * dt);
        self.time += dt;
        self.count_work(&before, &force);
    }

    /// Moves the particles to given places by one step, whatever the forces are, and counts what the repulsive one does.
    pub fn lead(&mut self, to: impl Fn(DVec3) -> DVec3, dt: f64) {
        let (before, force) = (self.position.clone(), self.repulsion.clone());
        for a in 0..self.start.len() {
            self.velocity[a] = (to(self.start[a]) - self.position[a]) / dt;
        }
        self.drift(0.5 * dt);
        self.strain(dt);
        self.drift(0.5 * dt);
        self.accelerate();
        self.time += dt;
        self.count_work(&before, &force);
    }

    fn count_work(&mut self, before: &[DVec3], force: &[DVec3]) {
        for (a, old) in force.iter().enumerate() {
            let step = self.position[a] - before[a];
            self.work += 0.5 * self.mass * (*old + self.repulsion[a]).dot(step);
            self.work_of_lengths += self.mass * self.repulsion[a].length() * step.length();
        }
    }

    pub fn row(&self) -> Row {
        let square: f64 = self.velocity.iter().map(|v| v.length_squared()).sum();
        Row {
            time: self.time,
            speed: (square / self.velocity.len() as f64).sqrt(),
            kinetic: 0.5 * self.mass * square,
            work: self.work,
            work_of_lengths: self.work_of_lengths,
        }
    }

    /// Rows at equal intervals, from the start to the end.
    pub fn run(&mut self, duration: f64, rows: usize, dt: f64) -> Vec<Row> {
        let steps = (duration / (rows as f64 * dt)).ceil() as usize;
        let dt = duration / (rows * steps) as f64;
        let mut found = vec![self.row()];
        for _ in 0..rows {
            (0..steps).for_each(|_| self.step(dt));
            found.push(self.row());
        }
        found
    }
}

/// Slope of ln speed over the rows from a time on, by least squares.
pub fn growth(rows: &[(f64, f64)], from: f64) -> f64 {
    let late: Vec<(f64, f64)> = rows.iter().filter(|r| r.0 >= from && r.1 > 0.0).map(|&(t, v)| (t, v.ln())).collect();
    let n = late.len() as f64;
    let (t, y) = (late.iter().map(|r| r.0).sum::<f64>() / n, late.iter().map(|r| r.1).sum::<f64>() / n);
    late.iter().map(|r| (r.0 - t) * (r.1 - y)).sum::<f64>() / late.iter().map(|r| (r.0 - t).powi(2)).sum::<f64>()
}
