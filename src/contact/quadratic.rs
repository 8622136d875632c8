//! phi = (1 - q)^2: the force starts with a kink and stays finite. Twin: shaders/contact/quadratic.wgsl

use crate::tensor::Real;

/// phi, -phi' and phi''.
#[inline(always)]
pub fn at<R: Real>(q: R, _: u32) -> (R, R, R) {
    let left = R::of(1.0) - q;
    (left * left, R::of(2.0) * left, R::of(2.0))
}
