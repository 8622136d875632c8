//! Quadratic kernel of Johnson 1996 as in Strand 3.1.1.1. Twin: shaders/smoothing/quadratic.wgsl

use super::Kernel;
use crate::tensor::Real;
use std::f64::consts::PI;

#[derive(Debug, Clone, Copy)]
pub struct Quadratic;

impl Kernel for Quadratic {
    const NORMALISATION: [f64; 3] = [1.0, 2.0 / PI, 5.0 / (4.0 * PI)];

    #[inline(always)]
    fn shape<R: Real>(q: R) -> R {
        let outer = (R::of(2.0) - q).max(R::of(0.0));
        R::of(0.1875) * outer * outer
    }

    #[inline(always)]
    fn slope<R: Real>(q: R) -> R {
        -R::of(0.375) * (R::of(2.0) - q).max(R::of(0.0))
    }
}
