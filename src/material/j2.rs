//! Strength of metals that harden: s0 + B k^n, Ludwik 1909, k the equivalent plastic strain; perfect plasticity where B is
//! 0, linear hardening where n is 1. Twin: shaders/material/j2.wgsl

use super::point::{Flow, Point};
use crate::rows::Body;
use crate::tensor::Real;

super::law::law! {
    J2, j2, Strength, "metal plasticity: flows where the Mises stress reaches `yield_stress`, which may harden";
    reads: [], remembers: [InelasticStrain, EquivalentPlasticStrain];
    yield_stress: STRESS, Range::Positive, None, 0.05, "Mises stress at which the body begins to flow";
    hardening: STRESS, Range::NotNegative, Some(0.0), 0.1, "modulus of linear hardening, or the factor of a power of the equivalent plastic strain";
    hardening_exponent: NONE, Range::UpTo(0.0, 1.0), Some(1.0), 0.3, "exponent of the equivalent plastic strain, typed as `exponent` inside `hardening`";
}

/// k^n for k >= 0, by a logarithm and an exponential as in the shader twin `power_of`; 0 at k = 0.
#[inline(always)]
pub(super) fn power<R: Real>(k: R, exponent: R) -> R {
    if k > R::of(0.0) { (exponent * k.ln()).exp() } else { R::of(0.0) }
}

/// Flow stress and its slope. At k = 0 the slope of a power is infinite and 0 stands for it: with an infinite slope the first
/// guess of the growth would be 0, from where Newton's method in ln d cannot start.
#[inline(always)]
pub fn flow<R: Real>(body: &Body<R>, at: &Point<R>) -> Flow<R> {
    let (own, zero) = (J2::of(body), R::of(0.0));
    if own.hardening_exponent == R::of(1.0) {
        return Flow { stress: own.yield_stress + own.hardening * at.strain, by_strain: own.hardening, by_rate: zero };
    }
    let grown = own.hardening * power(at.strain, own.hardening_exponent);
    let by_strain = if at.strain > zero { own.hardening_exponent * grown / at.strain } else { zero };
    Flow { stress: own.yield_stress + grown, by_strain, by_rate: zero }
}
