//! Lists the facets that each facet may touch before the list is made anew: near, facing, and of another body or far
//! apart in the reference configuration. Twin: shaders/pass/find_facet_contacts.wgsl

use super::Stage;
use super::declaration::{Declaration, FACETS, Runs, always, when};
use super::find_neighbors::visit_cells;
use crate::facet::facet_separation;
use crate::rows::Fault;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "lists the facets that each facet may touch",
        entries: FACETS,
        runs: Runs::Rebuilding,
        own: &[
            always(&[
                ReferencePosition,
                FacetOwner,
                FacetReferencePosition,
                FacetDisplacement,
                FacetNormal,
                CellStart,
                CellParticles,
            ]),
            when(|m| m.many_bodies, &[Body]),
        ],
        neighbours: &[
            always(&[ReferencePosition, FirstFacet, Facets, FacetReferencePosition, FacetDisplacement, FacetNormal]),
            when(|m| m.many_bodies, &[Body]),
        ],
        writes: &[always(&[FacetContactCount, FacetContacts])],
    }
};

/// Largest n_e.n_f that enters the list: facets that stand across each other hardly touch.
const MOST_TURN: f64 = -0.05;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let (total, capacity) = (state.params.facet_count as usize, state.params.facet_capacity as usize);
    let mut found = vec![Vec::new(); total];
    super::write(&mut found, |e, list| *list = list_one(state, e));
    let columns = &mut state.columns;
    for (e, (list, count)) in found.iter().zip(&mut columns.facet_contact_count).enumerate() {
        *count = if list.len() > capacity { 0 } else { list.len() as u32 };
        for (k, &f) in list.iter().take(capacity).enumerate() {
            columns.facet_contacts[k * total + e] = f;
        }
    }
    if found.iter().any(|list| list.len() > capacity) {
        state.clock.fault = Fault::ListFull as u32;
    }
}

fn list_one<S: Space>(state: &State<S>, e: usize) -> Vec<u32> {
    let mut list = Vec::new();
    let columns = &state.columns;
    let reach = state.params.facet_reach;
    let position = columns.facet_reference_position[e] + columns.facet_displacement[e];
    visit_cells::<S>(state, position, |b| {
        if may_touch(state, e, b as usize) {
            for f in state.facets_of(b as usize) {
                let x = facet_separation(state, e, f);
                let turn = S::inner(columns.facet_normal[e], columns.facet_normal[f]);
                if S::inner(x, x) < reach * reach && turn < S::Real::of(MOST_TURN) {
                    list.push(f as u32);
                }
            }
        }
        Some(())
    });
    list
}

/// Whether the facets of particle b may touch facet e.
fn may_touch<S: Space>(state: &State<S>, e: usize, b: usize) -> bool {
    let a = state.columns.facet_owner[e] as usize;
    if state.facet_pair(a, b).stiffness == S::Real::of(0.0) {
        return false;
    }
    let apart = state.columns.reference_position[a] - state.columns.reference_position[b];
    let least = state.params.contact_apart;
    state.body_index(a) != state.body_index(b) || S::inner(apart, apart) > least * least
}
