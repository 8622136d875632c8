//! phi = -(1 - q)^2 ln q (the barrier of Li et al. 2020, Incremental Potential Contact): force and stiffness start
//! from zero, and no energy suffices to bring two particles together. Twin: shaders/contact/barrier.wgsl

use crate::tensor::Real;

/// phi and -phi'.
#[inline(always)]
pub fn at<R: Real>(q: R, _: u32) -> (R, R) {
    let (left, logarithm) = (R::of(1.0) - q, q.ln());
    (-left * left * logarithm, left * (left / q - R::of(2.0) * logarithm))
}
