//! H_a = sum V_b (u_b - u_a) (x) grad psi_b(X_a) in the reference configuration, Shutov & Klyuchantsev 2019 (8).
//! Twin: shaders/pass/deform_by_shape.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::rows::{NEIGHBOR_BITS, NEIGHBOR_MASK};
use crate::shape_function::{Shape, nodes, seen};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "deformation gradient from displacements, Shutov & Klyuchantsev (8)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[Displacement]),
            when(|m| !m.kept_gradients() && m.many_bodies, &[Body]),
            when(|m| !m.kept_gradients(), &[ReferencePosition, ReferenceVolume, NeighborCount, Neighbors]),
            when(|m| !m.kept_gradients() && m.correction(), &[ShapeFactor, ShapeSlope, ShapeFactorGradient, ShapeSlopeGradient]),
            when(|m| m.kept_gradients(), &[KeptCount, KeptNeighbors, KeptGradients]),
        ],
        neighbours: &[
            always(&[Displacement]),
            when(|m| !m.kept_gradients() && m.many_bodies, &[Body]),
            when(|m| !m.kept_gradients(), &[ReferencePosition, ReferenceVolume]),
        ],
        writes: &[always(&[DisplacementGradient])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.method.list_follows() {
        fill!(state, displacement_gradient, |a, slot| *slot = sum_kept(state, a));
    } else {
        fill!(state, displacement_gradient, |a, slot| *slot = sum_nodes(state, a));
    }
}

/// u_b - u_a
#[inline(always)]
fn difference<S: Space>(state: &State<S>, a: usize, b: usize, image: u32) -> S::Vec {
    seen(state, image, state.columns.displacement[b]) - state.columns.displacement[a]
}

#[inline(always)]
fn sum_nodes<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let shape = Shape::of(state, a);
    let mut sum = S::Mat::default();
    for node in nodes(state, a, true) {
        let gradient = shape.gradient(node.x, node.weight, node.slope) * node.volume;
        sum += S::outer(difference(state, a, node.b, node.image), gradient);
    }
    sum
}

#[inline(always)]
fn sum_kept<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let count = state.params.count as usize;
    let mut sum = S::Mat::default();
    for k in 0..state.columns.kept_count[a] as usize {
        let entry = state.columns.kept_neighbors[k * count + a];
        let (b, image) = ((entry & NEIGHBOR_MASK) as usize, entry >> NEIGHBOR_BITS);
        sum += S::outer(difference(state, a, b, image), state.columns.kept_gradients[k * count + a]);
    }
    sum
}
