//! The velocity filter: what XSPH became in Fuller's code. It dissipates, and it stops a rotating disc.
//! Twin: shaders/pass/filter_velocity.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "puts the smoothed velocity in the velocity's place",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[always(&[SmoothedVelocity]), when(|m| m.constraints, &[Constraint])],
        neighbours: &[],
        writes: &[always(&[Velocity])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    fill!(state, velocity, |a, slot| {
        if !state.method.constraints || state.columns.constraint[a] == 0 {
            *slot = state.columns.smoothed_velocity[a];
        }
    });
}
