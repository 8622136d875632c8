//! Ascending order inside each cell. Twin: shaders/pass/sort_cells.wgsl

use super::Stage;
use super::declaration::{CELLS, Declaration, Runs, always};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "orders the particles of a cell, so that sums do not depend on the threads",
        entries: CELLS,
        runs: Runs::Rebuilding,
        own: &[always(&[CellStart, CellParticles])],
        neighbours: &[],
        writes: &[always(&[CellParticles])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    for cell in 0..state.params.cell_total as usize {
        let range = state.columns.cell_start[cell] as usize..state.columns.cell_start[cell + 1] as usize;
        state.columns.cell_particles[range].sort_unstable();
    }
}
