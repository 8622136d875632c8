//! u += part step v, or the smoothed velocity for XSPH. Twin: shaders/pass/drift.wgsl

use super::{Stage, compensated_add};
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let part = S::Real::of(stage.part) * state.clock.step;
    let mut displacement = std::mem::take(&mut state.columns.displacement);
    if state.method.compensated {
        let mut carry = std::mem::take(&mut state.columns.displacement_carry);
        for (a, (u, c)) in displacement.iter_mut().zip(&mut carry).enumerate() {
            compensated_add::<S>(u, c, moving_velocity(state, a) * part);
        }
        state.columns.displacement_carry = carry;
    } else {
        super::write(&mut displacement, |a, u| *u += moving_velocity(state, a) * part);
    }
    state.columns.displacement = displacement;
}

/// The velocity that moves a particle: a prescribed one is never smoothed.
#[inline(always)]
pub fn moving_velocity<S: Space>(state: &State<S>, a: usize) -> S::Vec {
    let held = state.method.constraints && state.columns.constraint[a] != 0;
    if state.method.xsph && !held { state.columns.smoothed_velocity[a] } else { state.columns.velocity[a] }
}
