//! Metal plasticity of von Mises: elasticity as of [`super::maxwell`], C_i = C_p, and a flow that stops where the Mises
//! stress q = sqrt(3/2)|tau^D| is at the yield stress sY(k), see [`super::hardening`].
//!
//! A Maxwell body that relaxes only as far as yield asks: the associated flow d_p = (3/2) (tau^D/q) k' is
//! dC_p/dt = (3 mu/q) k' X^D C_p, so a step ends at the unimodular part of C_p + w C', and the weight w is found from
//! q = sY. Nothing here turns with the body, and det C_p stays 1.
//! Twin: shaders/material/j2.wgsl

use super::Memory;
use super::hardening::{increment, yield_stress};
use super::maxwell::{Mixed, over, relaxed, whole};
use super::strain::{cube_root_change, lacking, unimodular_strain};
use crate::rows::Body;
use crate::tensor::{Real, Space};

/// Rounds that make q = sY: each gains as many digits as the trial strain is small.
const ROUNDS: usize = 5;

/// The invariants of A = C_p C'^-1 = b_e^-1 that the Mises stress needs, of first, second and third order in strain.
struct Invariants<R> {
    /// tr A/3
    mean: R,
    /// tr A^D A^D
    square: R,
    /// det A^D
    cube: R,
}

impl<R: Real> Invariants<R> {
    fn of<S: Space<Real = R>>(strain: Mixed<S>) -> Self {
        let deviator = strain.deviator();
        Self {
            mean: R::of(1.0) + strain.trace() * R::of(1.0 / 3.0),
            square: deviator.inner(deviator),
            cube: deviator.determinant(),
        }
    }

    /// q/mu and rho of b_e = rho (A + w)^-1, rho^3 = det(A + w). With m = mean + w, the deviator of the inverse is
    /// (-m D + D D - D:D/3)/det: no sum here is of numbers near 1, or cancels.
    fn mises(&self, w: R) -> (R, R) {
        let m = self.mean + w;
        let part = (self.cube / m - R::of(0.5) * self.square) / (m * m);
        let rho = m * (R::of(1.0) + cube_root_change(part));
        let norm = self.square * (m * m + self.square * R::of(1.0 / 6.0)) - R::of(6.0) * m * self.cube;
        ((R::of(1.5) * norm.max(R::of(0.0))).sqrt() / (rho * rho), rho)
    }
}

/// sqrt(3 J2) of a deviator, the components on axes that the dimension lacks included.
pub fn mises<S: Space>(deviator: S::Sym) -> S::Real {
    let within = S::mat_of_sym(deviator);
    let rest = S::sym_trace(deviator);
    let across = if S::DIMENSION == 3 { S::Real::of(0.0) } else { rest * rest / lacking::<S>() };
    (S::Real::of(1.5) * (S::trace(S::mat_mat(within, within)) + across)).sqrt()
}

/// Eulerian: the deviator returned to the yield surface, the growth of k, and the plastic work per volume by the
/// trapezoid of sY over k, as the motion does its work by that of the stress.
pub fn yielded<S: Space>(body: &Body<S::Real>, deviator: S::Sym, k: S::Real) -> (S::Sym, S::Real, S::Real) {
    let zero = S::Real::of(0.0);
    let (trial, before) = (mises::<S>(deviator), yield_stress(body, k).0);
    if body.yield_stress == zero || trial <= before {
        return (deviator, zero, zero);
    }
    let stiffness = S::Real::of(3.0) * body.shear_modulus;
    let growth = increment(body, trial, k, stiffness);
    let lost = stiffness * growth;
    (deviator * (S::Real::of(1.0) - lost / trial), growth, S::Real::of(0.5) * (before + trial - lost) * growth)
}

/// C_p - 1 and k after a step that ends at H.
///
/// At fixed H the flow follows A(w) = (A + w)/rho with dk = q/(3 mu rho) dw. The step takes the geometric mean of the
/// integrand's ends, which is exact for small strains: there q falls as 1/(1 + w) and by 3 mu dk, and this is the
/// radial return. Each round goes on as if strains were small.
pub fn relax<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: Memory<S>) -> Memory<S> {
    let (mu, one) = (body.shear_modulus, S::Real::of(1.0));
    let (total, plastic, k) = (unimodular_strain::<S>(h), whole::<S>(memory.0), memory.1);
    let invariants = Invariants::of(over::<S>(plastic, total, total));
    let trial = mu * invariants.mises(S::Real::of(0.0)).0;
    if trial <= yield_stress(body, k).0 {
        return memory;
    }
    let stiffness = S::Real::of(3.0) * mu;
    let mut growth = increment(body, trial, k, stiffness);
    let mut w = stiffness * growth / (trial - stiffness * growth);
    for _ in 0..ROUNDS {
        let (ratio, rho) = invariants.mises(w);
        let q = mu * ratio;
        growth = w * (trial * q / rho).sqrt() / stiffness;
        let (wanted, slope) = yield_stress(body, k + growth);
        let excess = (q - wanted) * stiffness / (stiffness + slope);
        w += (one + w) * excess / (q - excess);
    }
    (relaxed::<S>(h, memory.0, w), k + growth)
}
