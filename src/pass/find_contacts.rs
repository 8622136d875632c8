//! Lists the particles that each particle may touch before the list is made anew: near in the present
//! configuration, and of another body or far apart in the reference configuration, so that a body may touch
//! itself. Twin: shaders/pass/find_contacts.wgsl

use super::Stage;
use super::find_neighbors::visit_cells;
use crate::pair::{reference_separation, separation};
use crate::state::{Fault, State};
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 || state.clock.rebuild == 0 {
        return;
    }
    let count = state.params.count as usize;
    let mut contacts = std::mem::take(&mut state.contacts);
    let mut counts = std::mem::take(&mut state.particles.contact_count);
    let mut found = vec![Vec::new(); count];
    super::write(&mut found, |a, list| list_one(state, a, list));
    for (a, list) in found.iter().enumerate() {
        if list.len() > state.params.contact_capacity as usize {
            state.clock.fault = Fault::ListFull as u32;
            counts[a] = 0;
            continue;
        }
        counts[a] = list.len() as u32;
        for (k, &b) in list.iter().enumerate() {
            contacts[k * count + a] = b;
        }
    }
    state.contacts = contacts;
    state.particles.contact_count = counts;
    state.particles.listed_displacement.clone_from(&state.particles.displacement);
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
