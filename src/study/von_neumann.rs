//! Stability of the Eulerian equations on a uniform, uniformly stressed, infinite lattice: von Neumann's analysis.
//!
//! Particles at the points X_a of a square lattice are displaced by xi exp(i k.X_a). Density and stress follow by
//! integrating their rates from the uniform state, and the acceleration to first order is A(k) xi. A lattice looks
//! the same from x and from -x, so A is real, though not symmetric where a deviator rotates (Jaumann rate). Each
//! eigenvalue of A gives the growth rate Re sqrt(lambda) and the angular frequency |Im sqrt(lambda)|.
//!
//! Write o = X_b - X_a, V = dx^D, g = grad_a W(|o|), H = grad grad W. The sums over the lattice (`Sums`) are
//! Gamma = V sum sin(k.o) g, H = V sum (1 - cos(k.o)) H(o) and, for the adjoint form, the change of the moment
//! matrix K_a = sum V_b x_ba (x) g_ab, which comes from positions and from the neighbours' volumes. The artificial
//! stress has its own Gamma and H, of the potential that (W/W(dp))^n g belongs to. With XSPH positions move by the
//! part 1 - weight V sum (1 - cos(k.o)) W of what density and stress are integrated from.
//!
//! Monaghan's viscosity is not in A but beside it ([`Viscous`]); [`Lagrangian`] is the same for the Total Lagrangian formulation.
//!
//! Sources: Swegle, Hicks & Attaway 1995 (the criterion W'' sigma > 0); Monaghan 2000 and Gray, Monaghan & Swift
//! 2001 (artificial stress, scalar and principal).

mod lagrangian;
mod lattice;
mod viscous;
mod waves;

pub use lagrangian::{Damage, Elastic, Lagrangian};
pub(in crate::study) use lattice::second_derivative;
pub use lattice::{Lattice, fixed_wave_vectors, periodic_wave_vectors};
pub use viscous::Viscous;
pub use waves::{Mode, Waves, by_growth};

use super::eigen::principal;
use glam::{DMat3, DVec3};
use lattice::{Pair, pairs};

/// State and elasticity of the medium; P = K (rho/rho0 - 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// rho in the stressed state; a particle has the mass rho dx^D.
    pub density: f64,
    /// rho0, at which the pressure is zero.
    pub reference_density: f64,
    /// K.
    pub bulk_modulus: f64,
    /// mu; 0 for a fluid.
    pub shear_modulus: f64,
    /// Deviatoric stress S0 as xx, yy, zz, xy, yz, xz; components outside the dimension are ignored.
    pub deviator: [f64; 6],
}

impl Medium {
    /// Medium without shear stress at the given volume relative to that of zero pressure.
    pub fn at_volume(relative_volume: f64, reference_density: f64, bulk_modulus: f64, shear_modulus: f64) -> Self {
        let density = reference_density / relative_volume;
        Self { density, reference_density, bulk_modulus, shear_modulus, deviator: [0.0; 6] }
    }
    /// P, negative in tension.
    pub fn pressure(&self) -> f64 {
        self.bulk_modulus * (self.density / self.reference_density - 1.0)
    }
    /// c_p, from the present density.
    pub fn longitudinal_speed(&self) -> f64 {
        ((self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus) / self.density).sqrt()
    }
    /// c_s, from the present density.
    pub fn shear_speed(&self) -> f64 {
        (self.shear_modulus / self.density).sqrt()
    }
    /// sigma = S - P 1 within the lattice's own axes, zero elsewhere.
    fn stress(&self, dimension: usize) -> DMat3 {
        let [xx, yy, zz, xy, yz, xz] = self.deviator;
        let full = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        within(full - DMat3::IDENTITY * self.pressure(), dimension)
    }
    /// Rate of sigma for the velocity gradient L: equation of state, Hooke's law and Jaumann's rate.
    fn stress_rate(&self, gradient: DMat3, stress: DMat3) -> DMat3 {
        let (strain, spin) = ((gradient + gradient.transpose()) * 0.5, (gradient - gradient.transpose()) * 0.5);
        let divergence = trace(gradient);
        let pressure_rate = -self.bulk_modulus * self.density / self.reference_density * divergence;
        // The spherical part of sigma commutes with the spin, so sigma serves for S.
        (strain - DMat3::IDENTITY * (divergence / 3.0)) * (2.0 * self.shear_modulus) + spin * stress
            - stress * spin
            - DMat3::IDENTITY * pressure_rate
    }
}

/// Repulsion (R_a + R_b) f^n against clumping in tension, f = W(r)/W(spacing).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ArtificialStress {
    None,
    /// R_a = -epsilon |P_a|/rho_a^2 times the unit tensor where P_a < 0.
    Scalar {
        epsilon: f64,
        exponent: f64,
        spacing: f64,
    },
    /// Every tensile principal value s of sigma_a gives -epsilon s/rho_a^2 on its axis.
    Principal {
        epsilon: f64,
        exponent: f64,
        spacing: f64,
    },
    /// R_a = epsilon P_a/rho_a^2 times the unit tensor whatever the sign of P_a: repels in tension and attracts in
    /// compression; with a negative epsilon the other way round.
    Signed {
        epsilon: f64,
        exponent: f64,
        spacing: f64,
    },
}

impl ArtificialStress {
    /// Exponent and spacing.
    fn shape(self) -> Option<(f64, f64)> {
        match self {
            Self::None => None,
            Self::Scalar { exponent, spacing, .. }
            | Self::Principal { exponent, spacing, .. }
            | Self::Signed { exponent, spacing, .. } => Some((exponent, spacing)),
        }
    }
}

/// How velocity gradient and force are formed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gradient {
    /// L = sum V v_ba (x) g, dv/dt = sum m (sigma_a/rho_a^2 + sigma_b/rho_b^2) g.
    Plain,
    /// L K^-1 with the moment matrix K = sum V x_ba (x) g; the force as in `Plain`.
    Corrected,
    /// L K^-1, and the force adjoint to it: rho_a dv/dt = sum V_b (sigma_a K_a^-1 + sigma_b K_b^-1) g.
    Adjoint,
}

/// The sums over the lattice for one wave vector.
#[derive(Debug)]
struct Sums {
    gradient: DVec3,
    hessian: DMat3,
    repulsion: DVec3,
    repulsion_hessian: DMat3,
    /// V sum cos(k.o) o (x) g.
    moment: DMat3,
    /// V sum sin(k.o) o (x) H e_l for the three axes l.
    moment_slope: [DMat3; 3],
    /// Velocity that moves a particle over its own velocity: below one with XSPH.
    moves: f64,
}

impl Sums {
    // Not `Default`: glam's default matrix is the unit matrix.
    const ZERO: Self = Self {
        gradient: DVec3::ZERO,
        hessian: DMat3::ZERO,
        repulsion: DVec3::ZERO,
        repulsion_hessian: DMat3::ZERO,
        moment: DMat3::ZERO,
        moment_slope: [DMat3::ZERO; 3],
        moves: 1.0,
    };
}

/// The discrete equations on one lattice in one state, with the neighbours' kernel values worked out.
#[derive(Debug, Clone)]
pub struct Equations {
    lattice: Lattice,
    medium: Medium,
    artificial_stress: ArtificialStress,
    gradient: Gradient,
    xsph: f64,
    pairs: Vec<Pair>,
    /// K = kappa 1 on the lattice.
    kappa: f64,
    stress: DMat3,
    principal: (DVec3, DMat3),
}

impl Equations {
    pub fn new(lattice: Lattice, medium: Medium, artificial_stress: ArtificialStress, gradient: Gradient) -> Self {
        let pairs = pairs(&lattice, artificial_stress);
        let kappa = pairs.iter().map(|pair| pair.offset.dot(pair.gradient)).sum::<f64>() / lattice.dimension as f64;
        let stress = medium.stress(lattice.dimension);
        Self { lattice, medium, artificial_stress, gradient, xsph: 0.0, pairs, kappa, stress, principal: principal(stress) }
    }
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }
    pub fn medium(&self) -> &Medium {
        &self.medium
    }

    /// The same where particles move with the smoothed velocity v_a + weight sum V_b (v_b - v_a) W_ab.
    pub fn with_xsph(self, weight: f64) -> Self {
        Self { xsph: weight, ..self }
    }

    fn sums(&self, k: DVec3) -> Sums {
        let mut sums = Sums::ZERO;
        let smoothing: f64 = self.pairs.iter().map(|pair| pair.value * (1.0 - k.dot(pair.offset).cos())).sum();
        sums.moves = 1.0 - self.xsph * smoothing;
        let artificial = self.artificial_stress != ArtificialStress::None;
        for pair in &self.pairs {
            let (sin, cos) = k.dot(pair.offset).sin_cos();
            sums.gradient += pair.gradient * sin;
            sums.hessian += pair.hessian * (1.0 - cos);
            if artificial {
                sums.repulsion += pair.gradient * (sin * pair.repulsion);
                sums.repulsion_hessian += pair.repulsion_hessian * (1.0 - cos);
            }
            if self.gradient == Gradient::Adjoint {
                sums.moment += outer(pair.offset * cos, pair.gradient);
                for axis in 0..self.lattice.dimension {
                    sums.moment_slope[axis] += outer(pair.offset * sin, pair.hessian.col(axis));
                }
            }
        }
        sums
    }

    /// Column of A: the acceleration for xi along one axis. Rates carry a factor i, which meets the one of Gamma.
    /// Density and stress follow the velocities themselves, whose integral xi is, positions the smoothed ones.
    fn acceleration(&self, sums: &Sums, axis: usize) -> DVec3 {
        let xi = DVec3::AXES[axis];
        let correction = if self.gradient == Gradient::Plain { 1.0 } else { 1.0 / self.kappa };
        let displacement_gradient = outer(xi, sums.gradient * correction);
        let dilation = trace(displacement_gradient);
        let stress_rate = self.medium.stress_rate(displacement_gradient, self.stress);
        // (stress, its rate) K^-1 in the adjoint form, bare in the others.
        let (held, mut rate) = match self.gradient {
            Gradient::Adjoint => {
                let moment_rate = (outer(xi, sums.gradient) - sums.moment_slope[axis]) * sums.moves + sums.moment * dilation;
                let inverse = 1.0 / self.kappa;
                (self.stress * inverse, stress_rate * inverse - self.stress * moment_rate * (inverse * inverse))
            }
            _ => (self.stress, stress_rate),
        };
        // The density in sigma/rho^2 (adjoint: in the neighbours' volumes) falls with dilation.
        rate += held * (2.0 * dilation);
        let mut force = held * sums.hessian.col(axis) * (2.0 * sums.moves) - rate * sums.gradient;
        if self.artificial_stress != ArtificialStress::None {
            let (held, rate) = self.repulsion(stress_rate, dilation);
            let moved = held * sums.repulsion_hessian.col(axis) * (2.0 * sums.moves);
            force += moved - (rate + held * (2.0 * dilation)) * sums.repulsion;
        }
        force / self.medium.density
    }

    /// R rho^2 and its rate, at fixed density in the rho^2.
    fn repulsion(&self, stress_rate: DMat3, dilation: f64) -> (DMat3, DMat3) {
        let medium = &self.medium;
        match self.artificial_stress {
            ArtificialStress::Scalar { epsilon, .. } if medium.pressure() < 0.0 => self.share_of_pressure(epsilon, dilation),
            ArtificialStress::Signed { epsilon, .. } => self.share_of_pressure(epsilon, dilation),
            ArtificialStress::Principal { epsilon, .. } => {
                let (values, axes) = self.principal;
                let tensile = DMat3::from_diagonal(values.max(DVec3::ZERO));
                // Derivative of an isotropic function of a tensor, in principal axes: divided differences.
                let mut rate = axes.transpose() * stress_rate * axes;
                for i in 0..3 {
                    for j in 0..3 {
                        rate.col_mut(j)[i] *= tensile_share(values[i], values[j]);
                    }
                }
                let turn = |inner: DMat3| axes * inner * axes.transpose() * -epsilon;
                (turn(tensile), turn(rate))
            }
            _ => (DMat3::ZERO, DMat3::ZERO),
        }
    }
    /// epsilon P and its rate.
    fn share_of_pressure(&self, epsilon: f64, dilation: f64) -> (DMat3, DMat3) {
        let medium = &self.medium;
        let rate = -medium.bulk_modulus * medium.density / medium.reference_density * dilation;
        (DMat3::IDENTITY * (epsilon * medium.pressure()), DMat3::IDENTITY * (epsilon * rate))
    }
}

impl Waves for Equations {
    fn dimension(&self) -> usize {
        self.lattice.dimension
    }

    fn stiffness(&self, k: [f64; 3]) -> DMat3 {
        let sums = self.sums(DVec3::from(k));
        let column = |axis: usize| {
            if axis < self.lattice.dimension { self.acceleration(&sums, axis) } else { DVec3::ZERO }
        };
        DMat3::from_cols(column(0), column(1), column(2))
    }
}

/// (max(a, 0) - max(b, 0))/(a - b), and its limit for equal values.
fn tensile_share(a: f64, b: f64) -> f64 {
    let (low, high) = (a.min(b), a.max(b));
    if low > 0.0 {
        1.0
    } else if high > 0.0 {
        high / (high - low)
    } else {
        0.0
    }
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

fn trace(matrix: DMat3) -> f64 {
    matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z
}

/// The leading rows and columns, zero elsewhere.
fn within(matrix: DMat3, dimension: usize) -> DMat3 {
    let keep = DMat3::from_diagonal(DVec3::from_array(std::array::from_fn(|axis| (axis < dimension) as u8 as f64)));
    keep * matrix * keep
}

#[cfg(test)]
mod tests;
