//! Puts each particle into its cell's range, taking the counts back down to zero.
//! Twin: shaders/pass/fill_cells.wgsl, where threads race for places: [`super::sort_cells`] settles the order.

use super::Stage;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 || state.clock.rebuild == 0 {
        return;
    }
    for i in 0..state.params.count {
        let cell = state.columns.cell[i as usize] as usize;
        state.columns.cell_count[cell] -= 1;
        let place = state.columns.cell_start[cell] + state.columns.cell_count[cell];
        state.columns.cell_particles[place as usize] = i;
    }
}
