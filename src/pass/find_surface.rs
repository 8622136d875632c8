//! Finds which particles lie on the surface of their body: those with no more than a share of the most neighbours in the
//! kernel's range, and which of them are corners. Fuller 4.3.1: see [`crate::contact::zones`].
//! Twin: shaders/pass/find_surface.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::contact::zones::{CORNER, SURFACE};
use crate::pair::{reference_separation, separation};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "finds surfaces and corners by the number of neighbours, Fuller 4.3.1",
        entries: LISTED,
        runs: Runs::Running,
        own: &[always(&[ReferencePosition, Displacement, NeighborCount, Neighbors]), when(|m| m.many_bodies, &[Body])],
        neighbours: &[always(&[ReferencePosition, Displacement]), when(|m| m.many_bodies, &[Body])],
        writes: &[always(&[Surface])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    fill!(state, surface, |a, slot| *slot = kind_of(state, a, stage));
}

fn kind_of<S: Space>(state: &State<S>, a: usize, stage: Stage) -> u32 {
    let count = own_neighbors(state, a, stage.reference).count() as u32;
    if count <= state.params.corner_count {
        CORNER
    } else if count <= state.params.surface_count {
        SURFACE
    } else {
        0
    }
}

/// Neighbours of its body, or of one that it is tied to, in the kernel's range, and x_a - x_b. Where bodies are tied, a list of the
/// reference configuration has no others.
pub(super) fn own_neighbors<S: Space>(state: &State<S>, a: usize, reference: bool) -> impl Iterator<Item = (usize, S::Vec)> {
    let reach = S::Real::of(2.0) * state.smoothing_length(a);
    state.neighbors_of(a).iter().filter_map(move |&b| {
        let x = if reference { reference_separation(state, a, b) } else { separation(state, a, b) };
        let own = state.method.tied || state.body_index(a) == state.body_index(b as usize);
        (own && S::inner(x, x) < reach * reach).then_some((b as usize, x))
    })
}
