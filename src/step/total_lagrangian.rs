//! The passes of the Total Lagrangian formulation at their places in a step.

use super::{call, contact, drift_by, order};
use crate::method::{Gradient, Method};
use crate::pass::{Call, Pass};

/// Bonds, corrections and surfaces of the reference configuration.
pub(super) fn prepare(method: &Method, calls: &mut Vec<Call>) {
    order(true, calls);
    if method.gradient != Gradient::Plain {
        calls.push(call(Pass::CorrectReference));
    }
    if method.gradient == Gradient::Quadratic {
        calls.push(call(Pass::CorrectQuadratic));
    }
    if method.facets() {
        calls.push(call(Pass::AttachFacets));
    }
    if method.contact.zones.is_some() {
        contact::find_surface(false, true, calls);
    }
}

pub(super) fn begin_segment(_: &Method, _: &mut Vec<Call>) {}

/// From state to acceleration.
pub(super) fn force(method: &Method, calls: &mut Vec<Call>) {
    calls.push(call(Pass::Deform));
    contact::press_surfaces(method, calls);
    calls.push(call(Pass::BondForce));
    if method.viscosity {
        calls.push(call(Pass::BondFriction));
    }
    contact::force(method, calls);
    if method.facets() {
        calls.push(call(Pass::SurfaceForce));
    }
    if method.obstacles {
        calls.push(call(Pass::LoadObstacles));
    }
}

/// Leapfrog between the kicks.
pub(super) fn drift(method: &Method, calls: &mut Vec<Call>) {
    calls.push(drift_by(1.0));
    contact::move_obstacles(method, calls);
}

/// Stress follows from the positions: no other rate than the acceleration.
pub(super) fn rates(_: &Method, _: &mut Vec<Call>) {}

pub(super) fn rates_after_force(_: &Method, _: &mut Vec<Call>) {}
