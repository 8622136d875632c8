//! Moves every carried field into cell order, so that neighbours in space are neighbours in memory.
//! Twin: shaders/pass/reorder.wgsl, dispatched once for each field.

use super::Stage;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let order = std::mem::take(&mut state.columns.cell_particles);
    state.columns.reorder(&order);
    state.columns.cell_particles = order;
}
