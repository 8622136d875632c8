//! Stress linear in Green's strain: S = lambda tr E + 2 mu E, E = (H + H^T + H^T H)/2, P = (1 + H) S.
//! Twin: shaders/material/st_venant_kirchhoff.wgsl

use crate::state::Body;
use crate::tensor::{Real, Space};

#[inline(always)]
pub fn first_piola<S: Space>(body: &Body<S::Real>, h: S::Mat) -> S::Mat {
    let half = S::Real::of(0.5);
    let strain = S::sym_part(h) + S::sym_part(S::mat_mat(S::transpose(h), h)) * half;
    let lambda = body.bulk_modulus - body.shear_modulus * S::Real::of(2.0 / 3.0);
    let stress = strain * (S::Real::of(2.0) * body.shear_modulus) + S::diagonal(lambda * S::sym_trace(strain));
    let stress = S::mat_of_sym(stress);
    stress + S::mat_mat(h, stress)
}
