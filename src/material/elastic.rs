//! A strength that does not give way. Twin: shaders/material/elastic.wgsl

use super::point::{Flow, Point};
use crate::rows::Body;
use crate::tensor::Real;

super::law::law! {
    Elastic, elastic, Strength, "resists a change of shape and never gives way";
    reads: [], remembers: [];
}

/// Never asked: a body whose `yield_stress` is 0 does not yield.
#[inline(always)]
pub fn flow<R: Real>(_: &Body<R>, _: &Point<R>) -> Flow<R> {
    Flow { stress: R::of(0.0), by_strain: R::of(0.0), by_rate: R::of(0.0) }
}
