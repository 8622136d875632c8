//! Ascending order inside each cell. Twin: shaders/pass/sort_cells.wgsl

use super::Stage;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 || state.clock.rebuild == 0 {
        return;
    }
    for cell in 0..state.params.cell_total as usize {
        let range = state.columns.cell_start[cell] as usize..state.columns.cell_start[cell + 1] as usize;
        state.columns.cell_particles[range].sort_unstable();
    }
}
