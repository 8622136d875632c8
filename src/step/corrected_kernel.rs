//! The passes of Shutov & Klyuchantsev's method at their places in a step.

use super::{call, drift_by, list, order};
use crate::method::CorrectedKernel;
use crate::pass::{Call, Pass, Stage};

/// A call of a pass whose sums run over the reference configuration, or else over the current one.
fn summed(pass: Pass, reference: bool) -> Call {
    Call { pass, stage: Stage { reference, ..Stage::default() } }
}

/// What the reference configuration fixes, where F is found from displacements.
pub(super) fn prepare(options: CorrectedKernel, calls: &mut Vec<Call>) {
    if options.evolved() {
        return;
    }
    order(true, calls);
    if options.correction {
        calls.push(summed(Pass::ShapeFunction, true));
    }
    if options.keeps_gradients() {
        calls.push(summed(Pass::KeepGradients, true));
    }
}

/// Kept neighbours are indices into the columns of particles. Where neighbours are kept, the particles must therefore not be
/// reordered: the list is made, but the columns keep their order.
pub(super) fn begin_segment(options: CorrectedKernel, calls: &mut Vec<Call>) {
    if options.keeps_gradients() {
        list(false, calls);
    } else if options.current() {
        order(false, calls);
    }
}

/// From state to acceleration.
pub(super) fn force(options: CorrectedKernel, calls: &mut Vec<Call>) {
    if !options.evolved() {
        calls.push(summed(Pass::DeformByShape, true));
    }
    calls.push(call(Pass::ShapeStress));
    shape(options, calls);
    calls.push(summed(Pass::ShapeForce, !options.current()));
}

/// Shape functions of the present positions.
fn shape(options: CorrectedKernel, calls: &mut Vec<Call>) {
    if options.correction && options.current() {
        calls.push(summed(Pass::ShapeFunction, false));
    }
}

/// Leapfrog between the kicks: F is advanced in the middle, where positions and velocities are both at the half
/// step.
pub(super) fn drift(options: CorrectedKernel, calls: &mut Vec<Call>) {
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
