//! The velocity filter: what XSPH became in Fuller's code. It dissipates, and it stops a rotating disc.
//! Twin: shaders/pass/filter_velocity.wgsl

use super::Stage;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut velocity = std::mem::take(&mut state.columns.velocity);
    super::write(&mut velocity, |a, slot| {
        if !state.method.constraints || state.columns.constraint[a] == 0 {
            *slot = state.columns.smoothed_velocity[a];
        }
    });
    state.columns.velocity = velocity;
}
