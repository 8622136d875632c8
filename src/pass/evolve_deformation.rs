//! The velocity gradient L_a = sum V_b (v_b - v_a) (x) grad psi_b(x_a), Shutov & Klyuchantsev 2019 (6), which as
//! printed has v_b alone; and what it does to F, (9): in leapfrog F <- exp(step L) F, in Runge-Kutta the rate L F.
//! Both are written for H = F - 1, so that f32 keeps small strains. Twin: shaders/pass/evolve_deformation.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::method::VelocityGradient;
use crate::shape_function::{Shape, nodes, seen};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "advances the deformation gradient, or gives its rate, Shutov & Klyuchantsev (6), (9)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[
                ReferencePosition,
                ReferenceVolume,
                Displacement,
                Velocity,
                VolumetricStrain,
                DisplacementGradient,
                NeighborCount,
                Neighbors,
            ]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.correction(), &[ShapeFactor, ShapeSlope, ShapeFactorGradient, ShapeSlopeGradient]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, Velocity, VolumetricStrain]),
            when(|m| m.many_bodies, &[Body]),
        ],
        writes: &[when(|m| m.staged(), &[DisplacementGradientRate]), when(|m| !m.staged(), &[DisplacementGradient])],
    }
};

/// Terms of the exponential's series: all digits of f64 for steps that turn or stretch by a tenth.
const EXPONENTIAL_TERMS: u32 = 10;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.method.staged() {
        fill!(state, displacement_gradient_rate, |a, slot| {
            *slot = before::<S>(velocity_gradient(state, a), state.columns.displacement_gradient[a]);
        });
    } else {
        fill!(state, displacement_gradient, |a, slot| {
            let turn = exponential_less_one::<S>(velocity_gradient(state, a) * state.clock.step);
            *slot += before::<S>(turn, *slot);
        });
    }
}

/// A F = A + A H
#[inline(always)]
fn before<S: Space>(a: S::Mat, h: S::Mat) -> S::Mat {
    a + S::mat_mat(a, h)
}

/// exp A - 1 = A (1 + A/2 (1 + A/3 (…)))
#[inline(always)]
fn exponential_less_one<S: Space>(a: S::Mat) -> S::Mat {
    let mut rest = S::Mat::default();
    for k in (2..=EXPONENTIAL_TERMS).rev() {
        rest = before::<S>(a, rest) * S::Real::of(1.0 / f64::from(k));
    }
    before::<S>(a, rest)
}

#[inline(always)]
fn velocity_gradient<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let velocity = &state.columns.velocity;
    let printed = state.method.corrected_kernel.is_some_and(|sums| sums.velocity_gradient == VelocityGradient::Printed);
    let own = if printed { S::Vec::default() } else { velocity[a] };
    let shape = Shape::of(state, a);
    let mut sum = S::Mat::default();
    for node in nodes(state, a, false) {
        let gradient = shape.gradient(node.x, node.weight, node.slope) * node.volume;
        sum += S::outer(seen(state, node.image, velocity[node.b]) - own, gradient);
    }
    sum
}
