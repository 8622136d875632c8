//! Strains that keep their digits when small, and tensors of space where the dimension lacks axes.
//!
//! Everything starts from H = F - 1. In f32 a number near 1 holds a strain of 1e-6 to a tenth only, so each
//! formula here is one of differences from 1 that contains no such number less 1.
//! Twin: shaders/lib/strain.wgsl

use crate::tensor::{Real, Space};

/// A symmetric tensor of space. Across the axes that the dimension lacks (plane and uniaxial strain) it has one
/// component on each, and none off the diagonal.
#[derive(Debug, Clone, Copy)]
pub struct Whole<S: Space> {
    pub within: S::Sym,
    pub across: S::Real,
}

/// Number of axes that the dimension lacks.
#[inline(always)]
pub fn lacking<S: Space>() -> S::Real {
    S::Real::of(3.0 - S::DIMENSION as f64)
}

/// det(1 + M) - 1
#[inline(always)]
pub fn volume_change<S: Space>(m: S::Mat) -> S::Real {
    match S::DIMENSION {
        1 => S::trace(m),
        2 => S::trace(m) + S::determinant(m),
        _ => S::trace(m) + S::trace(S::adjugate(m)) + S::determinant(m),
    }
}

/// (1 + x)^(1/3) - 1 by Halley's iteration on c (3 + 3 c + c^2) = x. Its order is three: from 0, five rounds give
/// all digits of f64 from x = -0.99 to 100.
#[inline(always)]
pub fn cube_root_change<R: Real>(x: R) -> R {
    let three = R::of(3.0);
    let mut c = R::of(0.0);
    for _ in 0..5 {
        let excess = c * (three + c * (three + c)) - x;
        c = c - (R::of(1.0) + c) * excess / (three * (R::of(1.0) + x) + R::of(2.0) * excess);
    }
    c
}

/// J^(-2/3) - 1 from J - 1.
#[inline(always)]
pub fn isochoric_change<R: Real>(volume_change: R) -> R {
    let c = cube_root_change(volume_change);
    let root = R::of(1.0) + c;
    -c * (R::of(2.0) + c) / (root * root)
}

/// J^5 - 1 from J - 1.
#[inline(always)]
pub fn fifth_power_change<R: Real>(j: R) -> R {
    let (five, ten) = (R::of(5.0), R::of(10.0));
    j * (five + j * (ten + j * (ten + j * (five + j))))
}

/// C - 1 = H + H^T + H^T H
#[inline(always)]
pub fn right_strain<S: Space>(h: S::Mat) -> S::Sym {
    S::sym_part(h) * S::Real::of(2.0) + S::sym_part(S::mat_mat(S::transpose(h), h))
}

/// J^(-2/3) C - 1
#[inline(always)]
pub fn unimodular_strain<S: Space>(h: S::Mat) -> Whole<S> {
    let change = isochoric_change(volume_change::<S>(h));
    let within = right_strain::<S>(h) * (S::Real::of(1.0) + change) + S::diagonal(change);
    Whole { within, across: change }
}

/// (1 + M)^-1
#[inline(always)]
pub fn inverse_of_unit_and<S: Space>(m: S::Mat) -> S::Mat {
    let one = S::Real::of(1.0);
    S::adjugate(S::mat_identity() + m) * (one / (one + volume_change::<S>(m)))
}
