//! u += part step v, or the smoothed velocity for XSPH. Twin: shaders/pass/drift.wgsl

use super::{Stage, compensated_add};
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let part = S::Real::of(stage.part) * state.clock.step;
    let mut displacement = std::mem::take(&mut state.particles.displacement);
    if state.method.compensated {
        let mut carry = std::mem::take(&mut state.particles.displacement_carry);
        for (a, (u, c)) in displacement.iter_mut().zip(&mut carry).enumerate() {
            compensated_add::<S>(u, c, moving_velocity(state, a) * part);
        }
        state.particles.displacement_carry = carry;
    } else {
        super::write(&mut displacement, |a, u| *u += moving_velocity(state, a) * part);
    }
    state.particles.displacement = displacement;
}

/// The velocity that moves a particle: a prescribed one is never smoothed.
#[inline(always)]
pub fn moving_velocity<S: Space>(state: &State<S>, a: usize) -> S::Vec {
    let held = state.method.constraints && state.particles.constraint[a] != 0;
    if state.method.xsph && !held { state.particles.smoothed_velocity[a] } else { state.particles.velocity[a] }
}
