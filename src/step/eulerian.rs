//! The passes of the Eulerian formulation at their places in a step.

use super::{call, contact, list, list_present, sort};
use crate::contact::zones::Normals;
use crate::method::{Density, Gradient, Method};
use crate::pass::{Call, Pass};

/// Normals that stay those of the start.
pub(super) fn prepare(method: &Method, calls: &mut Vec<Call>) {
    if method.contact.zones.is_some_and(|zones| zones.normals == Normals::Initial) {
        // The particles are listed but not reordered: a resumed run then sums in the same order, and so to the same
        // bits, as an unbroken one.
        list(true, calls);
        contact::find_surface(false, true, calls);
    }
}

pub(super) fn begin_segment(method: &Method, calls: &mut Vec<Call>) {
    sort(false, calls);
    calls.push(call(Pass::Reorder));
    list_present(method, calls);
}

/// From state to acceleration.
pub(super) fn force(method: &Method, calls: &mut Vec<Call>) {
    if method.density == Density::Summation {
        calls.push(call(Pass::SumDensity));
    }
    if method.gradient == Gradient::Adjoint {
        calls.push(call(Pass::CorrectGradient));
    }
    calls.extend([Pass::SpecificStress, Pass::Force].map(call));
    contact::force(method, calls);
}

/// A fluid whose density is summed has no stress to carry from step to step.
fn stress_evolves(method: &Method) -> bool {
    method.shear || method.density == Density::Continuity
}

/// Leapfrog between the kicks, with the stress advanced in the middle of the drift: there positions and velocity are both
/// at the half step, so a rigid rotation makes no strain.
pub(super) fn drift(method: &Method, calls: &mut Vec<Call>) {
    if method.xsph {
        calls.push(call(Pass::SmoothVelocity));
    }
    calls.push(call(Pass::Drift));
    list_present(method, calls);
    calls.push(call(Pass::StrainRate));
    if stress_evolves(method) {
        calls.push(call(Pass::Stress));
    }
    calls.push(call(Pass::Drift));
}

/// Runge-Kutta: the rates of a stage but for the acceleration.
pub(super) fn rates(method: &Method, calls: &mut Vec<Call>) {
    calls.push(call(Pass::StrainRate));
    if stress_evolves(method) {
        calls.push(call(Pass::StressRate));
    }
    if method.xsph {
        calls.push(call(Pass::SmoothVelocity));
    }
}

pub(super) fn rates_after_force(_: &Method, _: &mut Vec<Call>) {}
