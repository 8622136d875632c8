//! Strand's partition of unity between a local and a non-local estimate, section 5.2: the Smoothing Length Criterion and
//! the Neighbourhood Criterion, linearised.
//!
//! On a lattice the force of a uniform stress is zero whatever the weights are, and so is the strain rate at rest, so
//! that to first order the weights are those of the undisturbed lattice: each criterion replaces the kernel's gradient
//! in one equation by a fixed mixture. For a fluid, with Gamma = V sum sin(k.o) g and H = V sum (1 - cos(k.o)) grad g,
//! rho A = -2 P H - (K rho/rho0 - 2 P) Gamma (x) Gamma', where Gamma' is that of the strain rate.

use super::case::{Case, zone};
use crate::study::eigen::eigenpairs;
use crate::study::von_neumann::{Lattice, second_derivative};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// Both estimates over the local neighbours, the non-local one with a wider kernel.
    SmoothingLength,
    /// The non-local estimate over the neighbours beyond the local ones.
    Neighbourhood,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Equation {
    Momentum,
    StrainRate,
}

/// Which sum of V W is the estimate of unity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unity {
    /// Local kernel and neighbours.
    Local,
    /// Wide kernel, the neighbours beyond the local ones alone: as the thesis prints it.
    Ring,
    /// Wide kernel, all that it reaches: what gives the thesis's 1.00076.
    Whole,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Partition {
    pub criterion: Criterion,
    pub equation: Equation,
    pub unity: Unity,
    /// lambda: non-local over local smoothing length.
    pub scale: f64,
    /// Factor on the non-local estimate; 10 in the thesis's last test.
    pub factor: f64,
    /// Gives the local estimate the weight of the non-local one and the other way round.
    pub swapped: bool,
}

impl Partition {
    pub fn new(criterion: Criterion, equation: Equation, unity: Unity, scale: f64) -> Self {
        Self { criterion, equation, unity, scale, factor: 1.0, swapped: false }
    }

    fn wide(&self, lattice: &Lattice) -> Lattice {
        Lattice { smoothing_length: self.scale * lattice.smoothing_length, ..*lattice }
    }

    /// Weights of the local and the non-local estimate.
    fn weights(&self, unity: f64) -> [f64; 2] {
        let [local, other] = if self.swapped { [1.0 - unity, unity] } else { [unity, 1.0 - unity] };
        [local, other * self.factor]
    }

    /// Whether a neighbour at a distance counts in the local and in the non-local estimate.
    fn counts(&self, lattice: &Lattice, r: f64) -> [bool; 2] {
        let local = r < 2.0 * lattice.smoothing_length;
        match self.criterion {
            Criterion::SmoothingLength => [local, local],
            Criterion::Neighbourhood => [local, !local],
        }
    }

    /// A mixture of something of the local lattice and of the one with the wide kernel.
    fn mixture(&self, lattice: &Lattice, unity: f64, r: f64, of: impl Fn(&Lattice) -> f64) -> f64 {
        let ([local, other], counts) = (self.weights(unity), self.counts(lattice, r));
        let part = |counts: bool, weight: f64, lattice: &Lattice| if counts { weight * of(lattice) } else { 0.0 };
        part(counts[0], local, lattice) + part(counts[1], other, &self.wide(lattice))
    }

    /// dW/dr of the mixture.
    pub fn slope(&self, lattice: &Lattice, unity: f64, r: f64) -> f64 {
        self.mixture(lattice, unity, r, |l| l.smoothing.derivative(r, l.smoothing_length, l.dimension))
    }

    /// W that a particle at a distance (0: the particle itself) adds to the estimate of unity, per volume.
    pub fn unity_term(&self, lattice: &Lattice, r: f64) -> f64 {
        let wide = self.wide(lattice);
        let value = |l: &Lattice| l.smoothing.value(r, l.smoothing_length, l.dimension);
        match self.unity {
            Unity::Local => value(lattice),
            Unity::Whole => value(&wide),
            Unity::Ring if r < 2.0 * lattice.smoothing_length => 0.0,
            Unity::Ring => value(&wide),
        }
    }

    /// Estimate of unity on the lattice.
    pub fn estimate(&self, lattice: &Lattice) -> f64 {
        let reach = 2.0 * lattice.smoothing_length * self.scale.max(1.0);
        let others: f64 = offsets(lattice.dimension, reach).iter().map(|o| self.unity_term(lattice, o.length())).sum();
        self.unity_term(lattice, 0.0) + others
    }

    /// Neighbours that the non-local estimate adds to the local ones, one at the very end of its reach too.
    pub fn ring(&self, lattice: &Lattice) -> usize {
        let inner = 2.0 * lattice.smoothing_length;
        offsets(lattice.dimension, inner * self.scale + 1e-9).iter().filter(|o| o.length() >= inner).count()
    }
}

/// Points of the lattice of spacing 1 nearer than `reach`, without the origin.
pub fn offsets(dimension: usize, reach: f64) -> Vec<DVec3> {
    let most = reach.ceil() as i32;
    let along = |axis: usize| if axis < dimension { -most..=most } else { 0..=0 };
    let points = along(0).flat_map(|i| along(1).flat_map(move |j| along(2).map(move |k| (i, j, k))));
    let points = points.map(|(i, j, k)| DVec3::new(f64::from(i), f64::from(j), f64::from(k)));
    points.filter(|o| *o != DVec3::ZERO && o.length() < reach).collect()
}

/// A neighbour's terms.
struct Term {
    offset: DVec3,
    /// Gradients in the momentum equation and in the strain rate.
    gradients: [DVec3; 2],
    hessian: DMat3,
}

/// Largest growth rate over the zone, in c/dx, of a fluid without a repulsive force.
pub fn growth(case: Case, partition: Option<Partition>) -> f64 {
    rates(case, partition, &zone(case.dimension)).into_iter().fold(0.0, f64::max)
}

/// Growth rates of waves, in c/dx.
pub fn rates(case: Case, partition: Option<Partition>, waves: &[[f64; 3]]) -> Vec<f64> {
    let lattice = case.lattice();
    let unity = partition.map_or(1.0, |p| p.estimate(&lattice));
    let reach = 2.0 * lattice.smoothing_length * partition.map_or(1.0, |p| p.scale.max(1.0));
    let mixed = |equation: Equation, r: f64, of: &dyn Fn(&Lattice) -> f64| match partition {
        Some(partition) if partition.equation == equation => partition.mixture(&lattice, unity, r, of),
        _ => of(&lattice),
    };
    let term = |&offset: &DVec3| {
        let r = offset.length();
        let slope = |l: &Lattice| l.smoothing.derivative(r, l.smoothing_length, l.dimension);
        let curvature = |l: &Lattice| if r < (2.0 - 1e-9) * l.smoothing_length { second_derivative(l, r) } else { 0.0 };
        let n = offset / r;
        let radial = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        let transverse = DMat3::IDENTITY - radial;
        let force = mixed(Equation::Momentum, r, &slope);
        Term {
            offset,
            gradients: [n * -force, n * -mixed(Equation::StrainRate, r, &slope)],
            hessian: radial * mixed(Equation::Momentum, r, &curvature) + transverse * (force / r),
        }
    };
    let terms: Vec<Term> = offsets(case.dimension, reach).iter().map(term).collect();
    let rate = |k: &[f64; 3]| {
        let pairs = eigenpairs(stiffness(case, &terms, DVec3::from(*k)), case.dimension);
        pairs.into_iter().map(|pair| pair.square_root()[0]).fold(0.0, f64::max)
    };
    waves.par_iter().map(rate).collect()
}

fn stiffness(case: Case, terms: &[Term], k: DVec3) -> DMat3 {
    let medium = case.medium();
    let (mut force, mut strain, mut hessian) = (DVec3::ZERO, DVec3::ZERO, DMat3::ZERO);
    for term in terms {
        let (sin, cos) = k.dot(term.offset).sin_cos();
        force += term.gradients[0] * sin;
        strain += term.gradients[1] * sin;
        hessian += term.hessian * (1.0 - cos);
    }
    let (pressure, bulk) = (medium.pressure(), medium.bulk_modulus * medium.density / medium.reference_density);
    let outer = DMat3::from_cols(force * strain.x, force * strain.y, force * strain.z);
    (hessian * (-2.0 * pressure) - outer * (bulk - 2.0 * pressure)) * (1.0 / medium.density)
}
