//! Puts each particle into its cell's range, taking the counts back down to zero.
//! Twin: shaders/pass/fill_cells.wgsl, where threads race for places: [`super::sort_cells`] settles the order.

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "puts each particle into its cell",
        entries: PARTICLES,
        runs: Runs::Rebuilding,
        own: &[always(&[Cell, CellCount, CellStart])],
        neighbours: &[],
        writes: &[always(&[CellCount, CellParticles])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    for i in 0..state.params.count {
        let cell = state.columns.cell[i as usize] as usize;
        state.columns.cell_count[cell] -= 1;
        let place = state.columns.cell_start[cell] + state.columns.cell_count[cell];
        state.columns.cell_particles[place as usize] = i;
    }
}
