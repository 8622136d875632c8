//! Moves every carried field into cell order, so that neighbours in space are neighbours in memory.
//! Twin: shaders/pass/reorder.wgsl, dispatched once for each field.

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always};
use super::write::with_columns;
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "moves all carried fields into cell order",
        entries: PARTICLES,
        runs: Runs::Always,
        // And of particles all that is carried, which the shader knows as `source` and `destination`.
        own: &[always(&[CellParticles])],
        neighbours: &[],
        writes: &[],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    // Over a segment's end the shader copies all the same, each particle to its own place: the pass runs always.
    if state.clock.running == 0 {
        return;
    }
    with_columns!(state, [cell_particles] => state.columns.reorder(&cell_particles));
}
