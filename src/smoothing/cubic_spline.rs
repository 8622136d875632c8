//! Cubic B-spline, Fuller (2.5) and (2.10) with the factor 9/4 of the derivative's square.
//! Twin: shaders/smoothing/cubic_spline.wgsl

use super::Kernel;
use crate::tensor::Real;
use std::f64::consts::PI;

#[derive(Debug, Clone, Copy)]
pub struct CubicSpline;

impl Kernel for CubicSpline {
    const NORMALISATION: [f64; 3] = [2.0 / 3.0, 10.0 / (7.0 * PI), 1.0 / PI];

    // Both branches in one: (2-q)^3/4 - (1-q)^3 with each bracket cut at zero. No branch, so it vectorises.
    #[inline(always)]
    fn shape<R: Real>(q: R) -> R {
        let outer = (R::of(2.0) - q).max(R::of(0.0));
        let inner = (R::of(1.0) - q).max(R::of(0.0));
        R::of(0.25) * outer * outer * outer - inner * inner * inner
    }

    #[inline(always)]
    fn slope<R: Real>(q: R) -> R {
        let outer = (R::of(2.0) - q).max(R::of(0.0));
        let inner = (R::of(1.0) - q).max(R::of(0.0));
        R::of(3.0) * inner * inner - R::of(0.75) * outer * outer
    }
}
