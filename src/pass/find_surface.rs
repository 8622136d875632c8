//! Finds which particles lie on the surface of their body: those with no more than a share of the most neighbours in the
//! kernel's range, and which of them are corners. Fuller 4.3.1: see [`crate::contact::zones`].
//! Twin: shaders/pass/find_surface.wgsl

use super::Stage;
use crate::contact::zones::{CORNER, SURFACE};
use crate::pair::{reference_separation, separation};
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut surface = std::mem::take(&mut state.columns.surface);
    super::write(&mut surface, |a, slot| *slot = kind_of(state, a, stage));
    state.columns.surface = surface;
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

/// Neighbours of its body in the kernel's range, and x_a - x_b.
pub(super) fn own_neighbors<S: Space>(state: &State<S>, a: usize, reference: bool) -> impl Iterator<Item = (usize, S::Vec)> {
    let reach = S::Real::of(2.0) * state.body(a).smoothing_length;
    state.neighbors_of(a).iter().filter_map(move |&b| {
        let x = if reference { reference_separation(state, a, b) } else { separation(state, a, b) };
        let own = state.body_index(a) == state.body_index(b as usize);
        (own && S::inner(x, x) < reach * reach).then_some((b as usize, x))
    })
}
