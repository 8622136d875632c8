//! The passes of Shutov & Klyuchantsev's method at their places in a step.

use super::{call, drift_by, list, order, placed};
use crate::method::{CorrectedKernel, Method};
use crate::pass::{Call, Pass};

fn options(method: &Method) -> CorrectedKernel {
    method.corrected_kernel.expect("a method of this formulation has its options")
}

/// What the reference configuration fixes, where F is found from displacements.
pub(super) fn prepare(method: &Method, calls: &mut Vec<Call>) {
    let options = options(method);
    if options.evolved() {
        return;
    }
    order(true, calls);
    if options.correction {
        calls.push(placed(Pass::ShapeFunction, true));
    }
    if options.keeps_gradients() {
        calls.push(placed(Pass::KeepGradients, true));
    }
}

/// Kept neighbours are indices into the columns of particles. Where neighbours are kept, the particles must therefore not be
/// reordered: the list is made, but the columns keep their order.
pub(super) fn begin_segment(method: &Method, calls: &mut Vec<Call>) {
    let options = options(method);
    if options.keeps_gradients() {
        list(false, calls);
    } else if options.current() {
        order(false, calls);
    }
}

/// From state to acceleration.
pub(super) fn force(method: &Method, calls: &mut Vec<Call>) {
    let options = options(method);
    if !options.evolved() {
        calls.push(placed(Pass::DeformByShape, true));
    }
    calls.push(call(Pass::ShapeStress));
    shape(options, calls);
    calls.push(placed(Pass::ShapeForce, !options.current()));
}

/// Shape functions of the present positions.
fn shape(options: CorrectedKernel, calls: &mut Vec<Call>) {
    if options.correction && options.current() {
        calls.push(placed(Pass::ShapeFunction, false));
    }
}

/// Leapfrog between the kicks: F is advanced in the middle, where positions and velocities are both at the half
/// step.
pub(super) fn drift(method: &Method, calls: &mut Vec<Call>) {
    let options = options(method);
    if options.evolved() {
        calls.push(drift_by(0.5));
        list(false, calls);
        shape(options, calls);
        calls.push(call(Pass::EvolveDeformation));
        calls.push(drift_by(0.5));
        return;
    }
    calls.push(drift_by(1.0));
    if options.current() {
        list(false, calls);
    }
}

/// Runge-Kutta: F has its rate with the velocity gradient, which sums the shape functions that the force has made.
pub(super) fn rates(_: &Method, _: &mut Vec<Call>) {}

pub(super) fn rates_after_force(method: &Method, calls: &mut Vec<Call>) {
    if options(method).evolved() {
        calls.push(call(Pass::EvolveDeformation));
    }
}
