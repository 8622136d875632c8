//! Adds the acceleration by zones: what owners do to a particle, less what it does to intruders as an owner, so that
//! momentum is kept to the last digit. Twin: shaders/pass/zone_force.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "adds the acceleration by zones",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[ReferenceVolume, Acceleration, ContactCount, Surface, Contacts, ZoneForces]),
            when(|m| m.many_bodies, &[Body]),
        ],
        neighbours: &[always(&[ContactCount, Surface, Contacts, ZoneForces])],
        writes: &[always(&[Acceleration])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    fill!(state, acceleration, |a, acceleration| {
        if state.columns.contact_count[a] > 0 {
            *acceleration += sum(state, a) * (S::Real::of(1.0) / state.mass(a));
        }
    });
}

fn sum<S: Space>(state: &State<S>, a: usize) -> S::Vec {
    let (count, surface) = (state.params.count as usize, &state.columns.surface);
    let mut force = S::Vec::default();
    for (k, b) in state.contacts_of(a).enumerate() {
        if surface[a] != 0 {
            force = force - state.columns.zone_forces[k * count + a];
        }
        if surface[b] != 0 {
            let place = state.contacts_of(b).position(|c| c == a);
            force += place.map_or(S::Vec::default(), |k| state.columns.zone_forces[k * count + b]);
        }
    }
    force
}
