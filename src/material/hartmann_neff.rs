//! Volumetric elasticity of Hartmann & Neff 2003, Shutov & Klyuchantsev 2019 (11): the mean Kirchhoff stress is
//! k/10 (J^5 - J^-5), and the energy per reference volume k/50 (J^5 + J^-5 - 2).
//! Twin: shaders/material/hartmann_neff.wgsl

use super::strain::fifth_power_change;
use crate::rows::Body;
use crate::tensor::Real;

super::law::law! {
    HartmannNeff, hartmann_neff, Pressure, "J^5 - J^-5, which no compression overcomes: that of `neo_hookean`";
    reads: [], remembers: [];
}

/// k/10 (J^5 - J^-5) from J - 1.
#[inline(always)]
pub(super) fn volumetric_stress<R: Real>(bulk_modulus: R, volume_change: R) -> R {
    let p = fifth_power_change(volume_change);
    bulk_modulus * R::of(0.1) * p * (R::of(2.0) + p) / (R::of(1.0) + p)
}

/// k/50 (J^5 + J^-5 - 2) from J - 1.
pub(super) fn volumetric_energy<R: Real>(bulk_modulus: R, volume_change: R) -> R {
    let p = fifth_power_change(volume_change);
    bulk_modulus * R::of(0.02) * p * p / (R::of(1.0) + p)
}

/// Mean Kirchhoff stress -J p from J - 1.
#[inline(always)]
pub fn kirchhoff<R: Real>(body: &Body<R>, volume_change: R) -> R {
    volumetric_stress(body.bulk_modulus, volume_change)
}

/// Energy per reference volume.
pub fn stored<R: Real>(body: &Body<R>, volume_change: R) -> R {
    volumetric_energy(body.bulk_modulus, volume_change)
}
