//! phi = -(1 - q)^2 ln q (the barrier of Li et al. 2020, Incremental Potential Contact): force and stiffness start
//! from zero, and no energy suffices to bring two particles together. Twin: shaders/contact/barrier.wgsl

use crate::tensor::Real;

/// phi, -phi' and phi''.
#[inline(always)]
pub fn at<R: Real>(q: R, _: u32) -> (R, R, R) {
    let (left, logarithm) = (R::of(1.0) - q, q.ln());
    let (twice, part) = (R::of(2.0) * logarithm, left / q);
    (-left * left * logarithm, left * (part - twice), part * (R::of(4.0) + part) - twice)
}
