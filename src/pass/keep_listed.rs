//! Keeps the displacements at which the list of facets is made. Twin: shaders/pass/keep_listed.wgsl

use super::Stage;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 || state.clock.rebuild == 0 {
        return;
    }
    let columns = &mut state.columns;
    columns.listed_displacement.clone_from(&columns.displacement);
}
