//! Compressible neo-Hookean body, Shutov & Klyuchantsev 2019 (11), (12): Kirchhoff stress
//! tau = mu J^(-2/3) B^D + k/10 (J^5 - J^-5) 1, P = tau F^-T, and the energy per reference volume
//! psi = mu/2 (J^(-2/3) tr B - 3) + k/50 (J^5 + J^-5 - 2).
//! Twin: shaders/material/neo_hookean.wgsl

use super::hartmann_neff::{volumetric_energy, volumetric_stress};
use super::strain::{inverse_of_unit_and, isochoric_change, lacking, right_strain, unimodular_strain, volume_change};
use crate::rows::Body;
use crate::tensor::{Real, Space};

super::law::law! {
    NeoHookean, neo_hookean, Whole, "neo-Hookean deviator, volumetric part of Hartmann & Neff: large strains";
    reads: [], remembers: [];
}

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

pub fn stored_energy<S: Space>(body: &Body<S::Real>, h: S::Mat) -> S::Real {
    let strain = unimodular_strain::<S>(h);
    let trace = S::sym_trace(strain.within) + lacking::<S>() * strain.across;
    body.shear_modulus * S::Real::of(0.5) * trace + volumetric_energy(body.bulk_modulus, volume_change::<S>(h))
}
