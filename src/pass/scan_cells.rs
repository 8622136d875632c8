//! Exclusive prefix sum of the cells' counts, in blocks whose totals are summed in between.
//! Twin: shaders/pass/scan_cells.wgsl

use super::Stage;
use crate::fields::SCAN_BLOCK;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 || state.clock.rebuild == 0 {
        return;
    }
    let mut total = 0;
    for (block, counts) in state.columns.cell_count.chunks(SCAN_BLOCK).enumerate() {
        state.columns.cell_block[block] = total;
        for (k, count) in counts.iter().enumerate() {
            state.columns.cell_start[block * SCAN_BLOCK + k] = total;
            total += count;
        }
    }
    let cells = state.params.cell_total as usize;
    state.columns.cell_start[cells] = total;
}
