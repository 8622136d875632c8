//! Quintic C2 kernel of Wendland 1995; on [0, 2h] in 1D it needs the constant 3/4.
//! Twin: shaders/smoothing/wendland.wgsl

use super::Kernel;
use crate::tensor::Real;
use std::f64::consts::PI;

#[derive(Debug, Clone, Copy)]
pub struct Wendland;

impl Kernel for Wendland {
    const NORMALISATION: [f64; 3] = [0.75, 7.0 / (4.0 * PI), 21.0 / (16.0 * PI)];

    #[inline(always)]
    fn shape<R: Real>(q: R) -> R {
        let outer = (R::of(1.0) - R::of(0.5) * q).max(R::of(0.0));
        let square = outer * outer;
        square * square * (R::of(2.0) * q + R::of(1.0))
    }

    #[inline(always)]
    fn slope<R: Real>(q: R) -> R {
        let outer = (R::of(1.0) - R::of(0.5) * q).max(R::of(0.0));
        -R::of(5.0) * q * outer * outer * outer
    }
}
