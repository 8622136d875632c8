//! A temperature that stays. Twin: shaders/material/isothermal.wgsl

use crate::rows::Body;
use crate::tensor::Real;

super::law::law! {
    Isothermal, isothermal, Heat, "the temperature stays";
    reads: [], remembers: [Temperature];
    temperature: TEMPERATURE, Range::NotNegative, None, 1.0, "temperature at the start";
}

/// By how much plastic work, per reference volume, raises the temperature.
#[inline(always)]
pub fn rise<R: Real>(_: &Body<R>, _: R) -> R {
    R::of(0.0)
}
