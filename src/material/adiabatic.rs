//! Heat of plastic work that has no time to flow away: c rho_0 dT = beta dw, Taylor & Quinney 1934.
//! Twin: shaders/material/adiabatic.wgsl

use crate::rows::Body;
use crate::tensor::Real;

super::law::law! {
    Adiabatic, adiabatic, Heat, "plastic work heats the particle that does it";
    reads: [], remembers: [Temperature];
    temperature: TEMPERATURE, Range::NotNegative, None, 1.0, "temperature at the start";
    specific_heat: SPECIFIC_HEAT, Range::Positive, None, 0.05, "heat per mass and temperature";
    work_fraction: NONE, Range::UpTo(0.0, 1.0), Some(1.0), 0.9, "beta, the part of the plastic work that becomes heat";
}

/// By how much plastic work, per reference volume, raises the temperature.
#[inline(always)]
pub fn rise<R: Real>(body: &Body<R>, work: R) -> R {
    let own = Adiabatic::of(body);
    own.work_fraction * work / (body.density * own.specific_heat)
}
