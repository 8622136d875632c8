//! Keeps the displacements at which the list of facets is made. Twin: shaders/pass/keep_listed.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "keeps the displacements at which the list of facets is made",
        entries: PARTICLES,
        runs: Runs::Rebuilding,
        own: &[always(&[Displacement])],
        neighbours: &[],
        writes: &[always(&[ListedDisplacement])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let columns = &mut state.columns;
    columns.listed_displacement.clone_from(&columns.displacement);
}
