//! Tells each facet the particle that carries it, once particles are in their order. Twin:
//! shaders/pass/attach_facets.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always};
use super::write::with_columns;
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "tells each facet the particle that carries it",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[always(&[FirstFacet, Facets])],
        neighbours: &[],
        writes: &[always(&[FacetOwner])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_columns!(state, [facet_owner] => {
        for a in 0..state.params.count as usize {
            facet_owner[state.facets_of(a)].fill(a as u32);
        }
    });
}
