//! Strand's repulsive force (2010, Annex 2): particle i is accelerated by sum m_j (-k f^n) grad_i W_ij, f = W(r)/W(h),
//! W the cubic spline, zero from r = 2h on. The force depends on the distance alone, so it has a potential,
//! m_i m_j k W(h) f^(n+1)/(n+1): phi = f^(n+1). The range is 2h, the strength m_i m_j k W(h)/(n+1), so that phi is 1 at
//! r = h. Finite where particles meet, 4^(n+1). Twin: shaders/contact/repulsive.wgsl

use crate::smoothing::{CubicSpline, Kernel, Smoothing};
use crate::tensor::Real;

/// n unless given: Strand's usual one.
pub const EXPONENT: u32 = 4;

/// phi, -phi' and phi''.
#[inline(always)]
pub fn at<R: Real>(q: R, exponent: u32) -> (R, R, R) {
    let (twice, at_h, n) = (R::of(2.0) * q, R::of(4.0), R::of(f64::from(exponent)));
    let f = at_h * CubicSpline::shape(twice);
    let lower = (1..exponent).fold(R::of(1.0), |product, _| product * f);
    let power = lower * f;
    let slope = R::of(-2.0) * at_h * CubicSpline::slope(twice);
    let (outer, inner) = ((R::of(2.0) - twice).max(R::of(0.0)), (R::of(1.0) - twice).max(R::of(0.0)));
    let bend = at_h * (R::of(6.0) * outer - R::of(24.0) * inner);
    let many = n + R::of(1.0);
    (power * f, many * power * slope, many * lower * (n * slope * slope + f * bend))
}

/// Strength of two particles of unit density and volume `volume` for k = 1: volume^2 W(h)/(n + 1).
pub fn strength(volume: f64, range: f64, exponent: u32, dimension: usize) -> f64 {
    let h = 0.5 * range;
    volume * volume * Smoothing::CubicSpline.value(h, h, dimension) / f64::from(exponent + 1)
}
