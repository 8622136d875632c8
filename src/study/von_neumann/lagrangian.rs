//! The Total Lagrangian equations on an infinite reference lattice with a uniform deformation, linearised.
//!
//! What the passes solve ([`crate::pass`]: deform, bond_force), with o = X_b - X_a, G = V_b grad_a W_ab and
//! w = -V_b W'(R)/R:
//!
//! H_a = [sum (u_b - u_a) (x) G] K^-1, b_a = P(1 + H_a) K^-1 - alpha E H_a,
//! rho_0 dv_a/dt = sum (b_a + b_b) G + 2 alpha E sum w (u_b - u_a).
//!
//! For u = (F - 1) X + xi exp(i k.X) and with Gamma = sum sin(k.o) G, gamma = K^-1 Gamma, C = dP/dF at the H that the
//! sums find:
//!
//! rho_0 A xi = -(C : xi (x) gamma) gamma - alpha E [2 sum w (1 - cos(k.o)) - gamma . Gamma] xi.
//!
//! The forces come from an energy, so A is symmetric: a wave grows or swings, never both. Without the hourglass term A
//! vanishes where Gamma does, at the edge of the zone: these motions cost no energy. The quadratic-exact gradient has
//! the same A: on a lattice that looks the same from x and from -x its second sum is zero and its first coefficient
//! K^-1. In the plain form K is 1.
//!
//! Bonds may be damaged: each sum over neighbours takes a bond's G and w times a factor. K is that of the damaged
//! bonds, as if they had been so when the reference configuration was prepared, or still that of whole ones.

use super::lattice::pairs;
use super::{ArtificialStress, Lattice, Waves, outer};
use crate::material;
use crate::method::Gradient;
use crate::pair::inverse_or;
use crate::rows::Body;
use crate::tensor::{Line, Plane, Solid, Space};
use glam::{DMat3, DVec3};

/// A uniform pattern of weakened bonds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Damage {
    /// By how much bonds that have a part along each axis are weakened: 0 whole, 1 cut.
    pub along: [f64; 3],
    /// The gradient correction stays that of whole bonds.
    pub whole_correction: bool,
}

impl Damage {
    /// What is left of the bond to the neighbour at that offset.
    pub fn factor(&self, offset: [f64; 3], spacing: f64) -> f64 {
        let left = |axis: usize| if offset[axis].abs() > 1e-6 * spacing { 1.0 - self.along[axis] } else { 1.0 };
        (0..3).map(left).product()
    }
}

/// An elastic body in a uniform state.
#[derive(Debug, Clone, Copy)]
pub struct Elastic {
    /// Density, moduli and law; one without memory.
    pub body: Body<f64>,
    /// Any but `corrected`, which the formulation lacks.
    pub gradient: Gradient,
    /// alpha, over Young's modulus.
    pub hourglass: f64,
    /// F.
    pub deformation: DMat3,
    pub damage: Damage,
}

/// Both ends of a bond and of the opposite one.
#[derive(Debug, Clone, Copy)]
struct Bonds {
    offset: DVec3,
    /// 2 G.
    gradient: DVec3,
    /// 2 w.
    weight: f64,
}

/// dP_iJ/dF_kL: entry [J][L] is the matrix of i and k.
type Tangent = [[DMat3; 3]; 3];

/// The discrete equations on one lattice in one state.
#[derive(Debug, Clone)]
pub struct Lagrangian {
    dimension: usize,
    bonds: Vec<Bonds>,
    correction: DMat3,
    tangent: Tangent,
    density: f64,
    /// alpha E.
    stiffness: f64,
}

impl Lagrangian {
    /// The lattice is that of the reference configuration.
    pub fn new(lattice: Lattice, elastic: &Elastic) -> Self {
        match lattice.dimension {
            1 => Self::of::<Line<f64>>(lattice, elastic),
            2 => Self::of::<Plane<f64>>(lattice, elastic),
            _ => Self::of::<Solid<f64>>(lattice, elastic),
        }
    }

    fn of<S: Space<Real = f64>>(lattice: Lattice, elastic: &Elastic) -> Self {
        let damage = &elastic.damage;
        let whole = bonds(&lattice, &Damage::default());
        let bonds = bonds(&lattice, damage);
        let corrected = elastic.gradient != Gradient::Plain;
        let correction = match (corrected, damage.whole_correction) {
            (false, _) => DMat3::IDENTITY,
            (true, true) => inverse::<S>(moment(&whole)),
            (true, false) => inverse::<S>(moment(&bonds)),
        };
        // What the sums make of the uniform displacement.
        let seen = (elastic.deformation - DMat3::IDENTITY) * moment(&bonds) * correction;
        Self {
            dimension: lattice.dimension,
            bonds,
            correction,
            tangent: tangent::<S>(&elastic.body, seen),
            density: elastic.body.density,
            stiffness: elastic.hourglass * elastic.body.youngs_modulus,
        }
    }

    /// (C : xi (x) gamma) gamma as a matrix that acts on xi.
    fn acoustic(&self, gamma: DVec3) -> DMat3 {
        let mut sum = DMat3::ZERO;
        for (j, row) in self.tangent.iter().enumerate() {
            for (l, block) in row.iter().enumerate() {
                sum += *block * (gamma[j] * gamma[l]);
            }
        }
        sum
    }

    /// Speeds of long waves along a unit vector of the reference configuration, the slowest first; not a number where
    /// the law has lost its ellipticity.
    pub fn speeds(&self, direction: [f64; 3]) -> Vec<f64> {
        let acoustic = self.acoustic(DVec3::from(direction));
        let pairs = crate::study::eigen::eigenpairs(acoustic, self.dimension);
        let mut speeds: Vec<f64> = pairs.iter().map(|pair| (pair.value[0] / self.density).sqrt()).collect();
        speeds.sort_by(f64::total_cmp);
        speeds
    }
}

impl Waves for Lagrangian {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn stiffness(&self, k: [f64; 3]) -> DMat3 {
        let k = DVec3::from(k);
        let (mut gamma, mut weights) = (DVec3::ZERO, 0.0);
        for bond in &self.bonds {
            let (sin, cos) = k.dot(bond.offset).sin_cos();
            gamma += bond.gradient * sin;
            weights += bond.weight * (1.0 - cos);
        }
        let corrected = self.correction * gamma;
        let hourglass = self.stiffness * (2.0 * weights - corrected.dot(gamma));
        let within = super::within(DMat3::IDENTITY, self.dimension);
        (self.acoustic(corrected) + within * hourglass) * (-1.0 / self.density)
    }
}

fn bonds(lattice: &Lattice, damage: &Damage) -> Vec<Bonds> {
    let bond = |pair: &super::Pair| {
        let left = damage.factor(pair.offset.into(), lattice.spacing);
        let gradient = pair.gradient * left;
        Bonds { offset: pair.offset, gradient, weight: gradient.dot(pair.offset) / pair.offset.length_squared() }
    };
    pairs(lattice, ArtificialStress::None).iter().map(bond).collect()
}

/// K.
fn moment(bonds: &[Bonds]) -> DMat3 {
    bonds.iter().fold(DMat3::ZERO, |sum, bond| sum + outer(bond.offset, bond.gradient))
}

/// K^-1 as the pass makes it; axes beyond the dimension are zero.
fn inverse<S: Space<Real = f64>>(moment: DMat3) -> DMat3 {
    from_space::<S>(inverse_or::<S>(to_space::<S>(moment), S::mat_identity()))
}

fn to_space<S: Space<Real = f64>>(matrix: DMat3) -> S::Mat {
    let mut m = S::Mat::default();
    for column in 0..S::DIMENSION {
        for row in 0..S::DIMENSION {
            m[S::mat_index(row, column)] = matrix.col(column)[row];
        }
    }
    m
}

fn from_space<S: Space<Real = f64>>(m: S::Mat) -> DMat3 {
    let mut matrix = DMat3::ZERO;
    for column in 0..S::DIMENSION {
        for row in 0..S::DIMENSION {
            matrix.col_mut(column)[row] = m[S::mat_index(row, column)];
        }
    }
    matrix
}

/// Derivative of the law's own stress: central differences of fourth order, exact to about 1e-11 of the moduli.
fn tangent<S: Space<Real = f64>>(body: &Body<f64>, displacement_gradient: DMat3) -> Tangent {
    const STEP: f64 = 5e-4;
    let stress = |k: usize, l: usize, amount: f64| {
        let mut h = displacement_gradient;
        h.col_mut(l)[k] += amount;
        from_space::<S>(material::first_piola::<S>(body, to_space::<S>(h), S::Sym::default()))
    };
    let mut tangent = [[DMat3::ZERO; 3]; 3];
    for k in 0..S::DIMENSION {
        for l in 0..S::DIMENSION {
            let near = stress(k, l, STEP) - stress(k, l, -STEP);
            let far = stress(k, l, 2.0 * STEP) - stress(k, l, -2.0 * STEP);
            let change = (near * 8.0 - far) * (1.0 / (12.0 * STEP));
            for (j, row) in tangent.iter_mut().enumerate() {
                *row[l].col_mut(k) = change.col(j);
            }
        }
    }
    tangent
}
