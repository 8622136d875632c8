//! Ends a step of several groups, after each has bounded its own: all take the shortest of the steps, and stop together; and
//! finds whether the list of contacts between groups still holds. Twin: shaders/pass/bound_between.wgsl

use super::Stage;
use super::bound_time_step::largest;
use super::declaration::{Declaration, Domain, Entry, Runs, always, when};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "brings groups to one time step; finds whether the list of contacts between them still holds",
        entries: &[Entry::new("blocks", Domain::ReductionBlocks), Entry::new("advance", Domain::One)],
        runs: Runs::Running,
        own: &[
            always(&[Velocity, BlockBound]),
            when(|m| m.contact.stiffens(), &[ContactRate]),
            when(|m| m.listed_again(), &[Displacement, ListedDisplacement]),
        ],
        neighbours: &[],
        writes: &[always(&[BlockBound])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let motion = largest(state, motion_of);
    agree(state, motion);
}

/// Squared rate of the contacts between groups, squared displacement since the list was built, and squared speed, where they stand in the bound of a group.
fn motion_of<S: Space>(state: &State<S>, a: usize) -> [S::Real; 4] {
    let columns = &state.columns;
    let moved = columns.listed_displacement.get(a).map_or(S::Vec::default(), |listed| columns.displacement[a] - *listed);
    let zero = S::Real::of(0.0);
    let rate = columns.contact_rate.get(a).copied().unwrap_or(zero);
    [rate, S::inner(moved, moved), S::inner(columns.velocity[a], columns.velocity[a]), zero]
}

/// A group that has less left than a rounding error of its step stops; then all do.
fn agree<S: Space>(state: &mut State<S>, motion: [S::Real; 4]) {
    let Some(&first) = state.group_clocks.first() else { return };
    let mut agreed = first;
    for group in &state.group_clocks {
        agreed.step = agreed.step.min(group.step);
        agreed.running = agreed.running.min(group.running);
        agreed.fault = if agreed.fault == 0 { group.fault } else { agreed.fault };
        agreed.lists_built = agreed.lists_built.max(group.lists_built);
        agreed.changes = agreed.changes.max(group.changes);
    }
    if state.clock.fault != 0 {
        (agreed.fault, agreed.running) = (state.clock.fault, 0);
    }
    if motion[0] > S::Real::of(0.0) && state.params.fixed_step == S::Real::of(0.0) {
        agreed.step = agreed.step.min(state.params.cfl / motion[0].sqrt());
    }
    let ahead = motion[1].sqrt() + motion[2].sqrt() * agreed.step;
    agreed.rebuild = u32::from(state.method.listed_again() && ahead > state.params.slack);
    state.clock = agreed;
    for group in &mut state.group_clocks {
        (group.step, group.running, group.fault) = (agreed.step, agreed.running, agreed.fault);
        group.held = agreed.step;
    }
}
