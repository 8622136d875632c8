//! Exclusive prefix sum of the cells' counts, in blocks whose totals are summed in between.
//! Twin: shaders/pass/scan_cells.wgsl

use super::Stage;
use super::declaration::{Declaration, Domain, Entry, Runs, always};
use crate::fields::SCAN_BLOCK;
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "prefix sum of the counts: where each cell's particles begin",
        entries: &[
            Entry::new("blocks", Domain::ScanBlocks),
            Entry::new("totals", Domain::One),
            Entry::new("offsets", Domain::ScanBlocks),
        ],
        runs: Runs::Rebuilding,
        own: &[always(&[CellCount, CellStart, CellBlock])],
        neighbours: &[],
        writes: &[always(&[CellStart, CellBlock])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
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
