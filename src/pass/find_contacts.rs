//! Lists the particles that each particle may touch before the list is made anew: near in the present
//! configuration, and of another body or far apart in the reference configuration, so that a body may touch
//! itself. Twin: shaders/pass/find_contacts.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::find_neighbors::visit_cells;
use super::write::{Wide, with_columns, write_rows};
use crate::pair::{reference_separation, separation};
use crate::rows::Fault;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "lists the particles that each particle may touch",
        entries: PARTICLES,
        runs: Runs::Rebuilding,
        own: &[always(&[ReferencePosition, Displacement, CellStart, CellParticles]), when(|m| m.many_bodies, &[Body])],
        neighbours: &[always(&[ReferencePosition, Displacement]), when(|m| m.many_bodies, &[Body])],
        writes: &[always(&[ListedDisplacement, ContactCount, Contacts])],
    }
};

/// Particles whose lists are found together.
const CHUNK: usize = 256;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_columns!(state, [contact_count, contacts] => {
        // The lists of a chunk are kept one after the other: few particles touch anything, so that most lists are empty.
        let mut found: Vec<Option<Vec<u32>>> = vec![None; contact_count.len().div_ceil(CHUNK)];
        let chunks = Wide { entries: &mut contact_count[..], width: CHUNK };
        write_rows((chunks, &mut found[..]), 1, |k, (counts, list)| *list = list_chunk(state, k * CHUNK, counts));
        let count = contact_count.len();
        for (first, list) in (0..).step_by(CHUNK).zip(&found) {
            let Some(list) = list else {
                state.clock.fault = Fault::ListFull as u32;
                continue;
            };
            let mut rest = list.iter();
            for a in (first..count.min(first + CHUNK)).take_while(|_| !list.is_empty()) {
                for (k, &b) in rest.by_ref().take(contact_count[a] as usize).enumerate() {
                    contacts[k * count + a] = b;
                }
            }
        }
    });
    state.columns.listed_displacement.clone_from(&state.columns.displacement);
}

/// The lists of a chunk of particles, one after the other, and their lengths; None if one is too long.
fn list_chunk<S: Space>(state: &State<S>, first: usize, counts: &mut [u32]) -> Option<Vec<u32>> {
    let (mut list, mut full) = (Vec::new(), false);
    for (k, count) in counts.iter_mut().enumerate() {
        let before = list.len();
        list_one(state, first + k, &mut list);
        *count = (list.len() - before) as u32;
        if *count > state.params.contact_capacity {
            full = true;
            list.truncate(before);
            *count = 0;
        }
    }
    if full { None } else { Some(list) }
}

fn list_one<S: Space>(state: &State<S>, a: usize, list: &mut Vec<u32>) {
    let params = &state.params;
    visit_cells::<S>(state, state.position(a), |b| {
        let apart = separation(state, a, b);
        let near = S::inner(apart, apart) < params.contact_reach * params.contact_reach;
        if near && b as usize != a && may_touch(state, a, b) {
            list.push(b);
        }
        Some(())
    });
}

fn may_touch<S: Space>(state: &State<S>, a: usize, b: u32) -> bool {
    if state.contact_pair(a, b as usize).range == S::Real::of(0.0) {
        return false;
    }
    let apart = reference_separation(state, a, b);
    state.body_index(a) != state.body_index(b as usize)
        || S::inner(apart, apart) > state.params.contact_apart * state.params.contact_apart
}
