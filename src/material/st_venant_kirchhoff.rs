//! Stress linear in Green's strain: psi = lambda/2 (tr E)^2 + mu E:E, E = (C - 1)/2, S = lambda tr E 1 + 2 mu E,
//! P = (1 + H) S. Not for strong compression: it loses ellipticity at a stretch of 0.8.
//! Twin: shaders/material/st_venant_kirchhoff.wgsl

use super::strain::right_strain;
use crate::rows::Body;
use crate::tensor::{Real, Space};

super::law::law! {
    StVenantKirchhoff, st_venant_kirchhoff, Whole, "stress linear in Green's strain: large rotations, small strains";
    reads: [], remembers: [];
}

#[inline(always)]
fn lambda<R: Real>(body: &Body<R>) -> R {
    body.bulk_modulus - body.shear_modulus * R::of(2.0 / 3.0)
}

#[inline(always)]
pub fn first_piola<S: Space>(body: &Body<S::Real>, h: S::Mat) -> S::Mat {
    let strain = right_strain::<S>(h);
    let volumetric = lambda(body) * S::Real::of(0.5) * S::sym_trace(strain);
    let stress = S::mat_of_sym(strain * body.shear_modulus + S::diagonal(volumetric));
    stress + S::mat_mat(h, stress)
}

/// Per reference volume.
pub fn stored_energy<S: Space>(body: &Body<S::Real>, h: S::Mat) -> S::Real {
    let strain = S::mat_of_sym(right_strain::<S>(h) * S::Real::of(0.5));
    let trace = S::trace(strain);
    lambda(body) * S::Real::of(0.5) * trace * trace + body.shear_modulus * S::trace(S::mat_mat(strain, strain))
}
