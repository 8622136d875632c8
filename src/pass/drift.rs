//! u += part step v, or the smoothed velocity for XSPH. Twin: shaders/pass/drift.wgsl

use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::{fill, with_columns};
use super::{Stage, compensated_add};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "advances the displacement by a part of the step",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[Displacement]),
            when(|m| m.xsph, &[SmoothedVelocity]),
            when(|m| m.xsph && m.constraints, &[Constraint]),
            when(|m| !m.xsph || m.constraints, &[Velocity]),
            when(|m| m.compensated, &[DisplacementCarry]),
        ],
        neighbours: &[],
        writes: &[always(&[Displacement]), when(|m| m.compensated, &[DisplacementCarry])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    let part = S::Real::of(stage.part) * state.clock.step;
    if state.method.compensated {
        with_columns!(state, [displacement, displacement_carry] => {
            for (a, (u, c)) in displacement.iter_mut().zip(&mut displacement_carry).enumerate() {
                compensated_add::<S>(u, c, moving_velocity(state, a) * part);
            }
        });
    } else {
        fill!(state, displacement, |a, u| *u += moving_velocity(state, a) * part);
    }
}

/// The velocity that moves a particle: a prescribed one is never smoothed.
#[inline(always)]
pub fn moving_velocity<S: Space>(state: &State<S>, a: usize) -> S::Vec {
    let held = state.method.constraints && state.columns.constraint[a] != 0;
    if state.method.xsph && !held { state.columns.smoothed_velocity[a] } else { state.columns.velocity[a] }
}
