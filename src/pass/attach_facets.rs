//! Tells each facet the particle that carries it, once particles are in their order. Twin:
//! shaders/pass/attach_facets.wgsl

use super::Stage;
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut owners = std::mem::take(&mut state.columns.facet_owner);
    for a in 0..state.params.count as usize {
        let range = state.facets_of(a);
        owners[range].fill(a as u32);
    }
    state.columns.facet_owner = owners;
}
