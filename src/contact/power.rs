//! phi = (1 - q)^2.5: the force grows with the power 1.5 of the overlap, as between two spheres (Hertz 1882), and so
//! does its slope from zero on. Twin: shaders/contact/power.wgsl

use crate::tensor::Real;

/// phi, -phi' and phi''.
#[inline(always)]
pub fn at<R: Real>(q: R, _: u32) -> (R, R, R) {
    let left = R::of(1.0) - q;
    let root = left.sqrt();
    let force = left * root;
    (left * force, R::of(2.5) * force, R::of(3.75) * root)
}
