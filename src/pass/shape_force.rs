//! Acceleration, Shutov & Klyuchantsev 2019 (5) in its adjoint reading:
//!
//! rho a_a = T_a = -sum V_b sigma_b grad psi_a(x_b),
//!
//! with the gradient at b of the shape function of a. Its power is then that of the stress on (6) as printed, the
//! sum of V_b sigma_b : L_b, and where the shape functions sum to one also on the differences. With the gradient at a
//! of b's function, as (5) may be read, the sign is wrong. In the reference configuration P stands for sigma and V_b
//! is the reference volume: the force is then minus the derivative of the energy. Twin: shaders/pass/shape_force.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::shape_function::{Node, Shape, nodes, seen};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "acceleration by the shape functions' gradients, Shutov & Klyuchantsev (5)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, ShapeStress, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.correction(), &[ShapeFactor, ShapeSlope, ShapeFactorGradient, ShapeSlopeGradient]),
            when(|m| m.current(), &[VolumetricStrain]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, ShapeStress]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.correction(), &[ShapeFactor, ShapeSlope, ShapeFactorGradient, ShapeSlopeGradient]),
            when(|m| m.current(), &[VolumetricStrain]),
        ],
        writes: &[always(&[Acceleration])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    fill!(state, acceleration, |a, slot| *slot = sum(state, a, stage.reference));
}

#[inline(always)]
fn sum<S: Space>(state: &State<S>, a: usize, reference: bool) -> S::Vec {
    let mut sum = S::Vec::default();
    for node in nodes(state, a, reference) {
        sum += pull(state, &node);
    }
    // Present volume over reference volume, J.
    let volume = if reference { S::Real::of(1.0) } else { S::Real::of(1.0) + state.columns.volumetric_strain[a] };
    sum * (-volume / state.body(a).density)
}

/// V_b sigma_b grad psi_a(x_b). For a mirror image, stress and gradient would all have to be mirrored. To mirror the separation
/// first and the resulting force afterwards gives the same.
#[inline(always)]
fn pull<S: Space>(state: &State<S>, node: &Node<S>) -> S::Vec {
    let from_a = seen(state, node.image, node.x * S::Real::of(-1.0));
    let gradient = Shape::of(state, node.b).gradient(from_a, node.weight, node.slope);
    let force = S::mat_vec(state.columns.shape_stress[node.b], gradient);
    seen(state, node.image, force) * (state.columns.reference_volume[node.b] * node.coupled)
}
