//! Elasticity beside an inelastic strain that is remembered, C_i - 1: neo-Hookean in what C has more than C_i.
//!
//! With X = C' C_i^-1 - 1 = (C' - C_i) C_i^-1, C' = J^(-2/3) C: P = F T = F^-T (mu X^D + tau_m 1), tau_m the mean
//! Kirchhoff stress. C_i is unimodular, which gives its components on the axes that the dimension lacks.
//! Twin: shaders/lib/inelastic.wgsl

use super::strain::{Whole, cube_root_change, inverse_of_unit_and, lacking, unimodular_strain, volume_change};
use crate::rows::Body;
use crate::tensor::{Real, Space};

/// A tensor of space without symmetry, laid out as [`Whole`].
#[derive(Clone, Copy)]
pub(super) struct Mixed<S: Space> {
    pub within: S::Mat,
    pub across: S::Real,
}

impl<S: Space> Mixed<S> {
    #[inline(always)]
    pub fn trace(self) -> S::Real {
        S::trace(self.within) + lacking::<S>() * self.across
    }
    /// tr (A B)
    #[inline(always)]
    pub fn inner(self, other: Self) -> S::Real {
        S::trace(S::mat_mat(self.within, other.within)) + lacking::<S>() * self.across * other.across
    }
    /// A - tr A/3
    pub fn deviator(self) -> Self {
        let third = self.trace() * S::Real::of(1.0 / 3.0);
        Self { within: self.within - S::mat_of_sym(S::diagonal(third)), across: self.across - third }
    }
    pub fn determinant(self) -> S::Real {
        let across = match S::DIMENSION {
            1 => self.across * self.across,
            2 => self.across,
            _ => S::Real::of(1.0),
        };
        S::determinant(self.within) * across
    }
}

/// C_i - 1 with the components that det C_i = 1 asks for: 1/det - 1 in the plane, 1/sqrt(C_xx) - 1 on a line.
#[inline(always)]
pub fn whole<S: Space>(memory: S::Sym) -> Whole<S> {
    let (one, change) = (S::Real::of(1.0), volume_change::<S>(S::mat_of_sym(memory)));
    let across = match S::DIMENSION {
        1 => {
            let root = (one + change).sqrt();
            -change / (root * (one + root))
        }
        2 => -change / (one + change),
        _ => S::Real::of(0.0),
    };
    Whole { within: memory, across }
}

/// (A - B) (1 + V)^-1 of the strains A, B and V.
#[inline(always)]
pub(super) fn over<S: Space>(a: Whole<S>, b: Whole<S>, v: Whole<S>) -> Mixed<S> {
    let inverse = inverse_of_unit_and::<S>(S::mat_of_sym(v.within));
    Mixed {
        within: S::mat_mat(S::mat_of_sym(a.within - b.within), inverse),
        across: (a.across - b.across) / (S::Real::of(1.0) + v.across),
    }
}

/// X
#[inline(always)]
pub(super) fn elastic_strain<S: Space>(h: S::Mat, memory: S::Sym) -> Mixed<S> {
    let viscous = whole::<S>(memory);
    over(unimodular_strain::<S>(h), viscous, viscous)
}

/// First Piola-Kirchhoff stress with a mean Kirchhoff stress.
#[inline(always)]
pub(super) fn first_piola<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym, mean: S::Real) -> S::Mat {
    let strain = elastic_strain::<S>(h, memory);
    let mean = mean - body.shear_modulus * S::Real::of(1.0 / 3.0) * strain.trace();
    let stress = strain.within * body.shear_modulus + S::mat_of_sym(S::diagonal(mean));
    S::mat_mat(S::transpose(inverse_of_unit_and::<S>(h)), stress)
}

/// Elastic energy of the change of shape per reference volume.
pub(super) fn isochoric_energy<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Real {
    body.shear_modulus * S::Real::of(0.5) * elastic_strain::<S>(h, memory).trace()
}

/// The unimodular part of C_i + weight C', less 1. Over (1 + weight) the sum differs from 1 by the weighted mean of
/// the strains.
#[inline(always)]
pub(super) fn relaxed<S: Space>(h: S::Mat, memory: S::Sym, weight: S::Real) -> S::Sym {
    let one = S::Real::of(1.0);
    let (total, viscous, share) = (unimodular_strain::<S>(h), whole::<S>(memory), one / (one + weight));
    let mean = (viscous.within + total.within * weight) * share;
    let across = (viscous.across + total.across * weight) * share;
    let within = volume_change::<S>(S::mat_of_sym(mean));
    let across = match S::DIMENSION {
        1 => across * (S::Real::of(2.0) + across),
        2 => across,
        _ => S::Real::of(0.0),
    };
    let root = cube_root_change(within + across + within * across);
    let change = -root / (one + root);
    mean * (one + change) + S::diagonal(change)
}

/// Heat of one step, per reference volume, from the state before it, (H, C_i - 1), to that after it.
///
/// The trapezoid of -d psi/dC_i = mu/2 C_i^-1 C' C_i^-1 over the change of C_i as it was made, not of
/// [`super::maxwell::dissipation`] over time: the update (16) is of first order, and yet kinetic, stored and dissipated energy
/// then sum to a constant to second order. Of C' C_i^-1 = 1 + X, the 1 gives nothing: C_i stays unimodular.
#[inline(always)]
pub fn dissipated<S: Space>(body: &Body<S::Real>, before: (S::Mat, S::Sym), after: (S::Mat, S::Sym)) -> S::Real {
    let (old, new) = (whole::<S>(before.1), whole::<S>(after.1));
    let first = elastic_strain::<S>(before.0, before.1).inner(over(new, old, old));
    let last = elastic_strain::<S>(after.0, after.1).inner(over(new, old, new));
    S::Real::of(0.25) * body.shear_modulus * (first + last)
}
