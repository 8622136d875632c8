//! Compressible neo-Hookean body, Shutov & Klyuchantsev 2019 (11), (12): Kirchhoff stress
//! tau = mu J^(-2/3) B^D + k/10 (J^5 - J^-5) 1, P = tau F^-T, and the energy per reference volume
//! psi = mu/2 (J^(-2/3) tr B - 3) + k/50 (J^5 + J^-5 - 2).
//! Twin: shaders/material/neo_hookean.wgsl

use super::strain::{
    fifth_power_change, inverse_of_unit_and, isochoric_change, lacking, right_strain, unimodular_strain, volume_change,
};
use crate::rows::Body;
use crate::tensor::{Real, Space};

#[inline(always)]
pub fn first_piola<S: Space>(body: &Body<S::Real>, h: S::Mat) -> S::Mat {
    let change = volume_change::<S>(h);
    // B is C of the transpose.
    let strain = right_strain::<S>(S::transpose(h));
    let deviator = strain - S::diagonal(S::sym_trace(strain) * S::Real::of(1.0 / 3.0));
    let shear_modulus = body.shear_modulus * (S::Real::of(1.0) + isochoric_change(change));
    let stress = deviator * shear_modulus + S::diagonal(volumetric_stress(body.bulk_modulus, change));
    S::mat_mat(S::mat_of_sym(stress), S::transpose(inverse_of_unit_and::<S>(h)))
}

/// k/10 (J^5 - J^-5) from J - 1.
#[inline(always)]
pub fn volumetric_stress<R: Real>(bulk_modulus: R, volume_change: R) -> R {
    let p = fifth_power_change(volume_change);
    bulk_modulus * R::of(0.1) * p * (R::of(2.0) + p) / (R::of(1.0) + p)
}

/// k/50 (J^5 + J^-5 - 2) from J - 1.
pub fn volumetric_energy<R: Real>(bulk_modulus: R, volume_change: R) -> R {
    let p = fifth_power_change(volume_change);
    bulk_modulus * R::of(0.02) * p * p / (R::of(1.0) + p)
}

pub fn stored_energy<S: Space>(body: &Body<S::Real>, h: S::Mat) -> S::Real {
    let strain = unimodular_strain::<S>(h);
    let trace = S::sym_trace(strain.within) + lacking::<S>() * strain.across;
    body.shear_modulus * S::Real::of(0.5) * trace + volumetric_energy(body.bulk_modulus, volume_change::<S>(h))
}
