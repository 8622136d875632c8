//! Moves every carried field into cell order, so that neighbours in space are neighbours in memory.
//! Twin: shaders/pass/reorder.wgsl, dispatched once for each field.

use super::Stage;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let order = std::mem::take(&mut state.cell_particles);
    state.particles.reorder(&order);
    state.cell_particles = order;
}
