//! Adds the acceleration by contacts that have an energy, and finds each particle's part of it. By a potential
//! m_a a_a += sum strength/range (-phi'(r/range)) x_ab/r, half of the pairs' energy; by the colour field see
//! [`crate::contact::colour_field`]. Twin: shaders/pass/contact_force.wgsl
//!
//! Potentials stiffen without limit as particles come close. The rate that bounds the step is therefore that of the present pairs
//! (Gershgorin: the sum over a row of stiffnesses over mass, twice), each as close as it may be a step later.

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::{GRAIN, fill, with_columns, write_rows};
use crate::contact::{COLOUR_FIELD, Potential};
use crate::pair::separation;
use crate::rows::ContactPair;
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "adds the acceleration by contact",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, Acceleration, ContactCount, Contacts]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.contact.stiffens(), &[Velocity]),
            when(|m| m.contact.colour_field, &[ColourExcess]),
        ],
        neighbours: &[
            always(&[ReferencePosition, Displacement]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.contact.stiffens(), &[Velocity]),
            when(|m| m.contact.colour_field, &[ReferenceVolume, ColourExcess]),
        ],
        writes: &[always(&[Acceleration, ContactEnergy]), when(|m| m.contact.stiffens(), &[ContactRate])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.method.contact.stiffens() {
        fill!(state, contact_rate, |a, rate| *rate = highest(state, a));
    }
    with_columns!(state, [acceleration, contact_energy] => {
        write_rows((&mut acceleration[..], &mut contact_energy[..]), GRAIN, |a, (acceleration, energy)| {
            *energy = S::Real::of(0.0);
            if state.columns.contact_count[a] > 0 {
                let (force, stored) = sum(state, a);
                *acceleration += force * (S::Real::of(1.0) / state.mass(a));
                *energy = stored;
            }
        });
    });
}

/// Square of the highest frequency that the particle's contacts may give it in the next step. A potential that begins with a kink
/// asks for so fine a step: with twice its length quadratic ones far stiffer than the bodies made energy.
fn highest<S: Space>(state: &State<S>, a: usize) -> S::Real {
    let (half, mut sum) = (S::Real::of(0.5), S::Real::of(0.0));
    // After an output the next step may be as long as that of the unstressed body.
    let ahead = state.clock.step.max(state.params.cfl * state.smoothing_length(a) / state.body(a).sound_speed);
    // What the body's own forces add to the speed. Those on the other particle are taken to be alike.
    let pull = state.columns.acceleration[a];
    let gained = ahead * S::inner(pull, pull).sqrt();
    for b in state.contacts_of(a) {
        let pair = state.contact_pair(a, b);
        let Some(potential) = Potential::ALL.get(pair.law as usize) else { continue };
        let x = separation(state, a, b as u32);
        let distance = S::inner(x, x).sqrt();
        // Particles that part may come back within a step: surfaces tremble.
        let relative = state.columns.velocity[a] - state.columns.velocity[b];
        let later = (distance - ahead * (S::inner(relative, relative).sqrt() + gained)).max(half * distance);
        let q = later / pair.range;
        if q < S::Real::of(1.0) {
            let (_, slope, bend) = potential.at(q, pair.exponent);
            sum += pair.strength * bend.abs().max(slope / q) / (pair.range * pair.range);
        }
    }
    S::Real::of(2.0) * sum / state.mass(a)
}

/// Force on a particle, and its part of the energy.
fn sum<S: Space>(state: &State<S>, a: usize) -> (S::Vec, S::Real) {
    let (mut force, mut energy) = (S::Vec::default(), S::Real::of(0.0));
    let (half, mut colour) = (S::Real::of(0.5), None);
    for b in state.contacts_of(a) {
        let pair = state.contact_pair(a, b);
        let x = separation(state, a, b as u32);
        let distance = S::inner(x, x).sqrt();
        if distance >= pair.range {
            continue;
        }
        if pair.law == COLOUR_FIELD {
            colour = Some(pair.strength);
            force += x * by_colour(state, pair, (a, b), distance);
        } else if let Some(potential) = Potential::ALL.get(pair.law as usize) {
            let (stored, slope, _) = potential.at(distance / pair.range, pair.exponent);
            energy += half * pair.strength * stored;
            force += x * (pair.strength * slope / (pair.range * distance));
        }
    }
    if let Some(stiffness) = colour {
        let excess = state.columns.colour_excess[a];
        energy += half * stiffness * state.columns.reference_volume[a] * excess * excess;
    }
    (force, energy)
}

/// -k V_a V_b (<c_a - c0> + <c_b - c0>) (dW/dr)/r
fn by_colour<S: Space>(state: &State<S>, pair: &ContactPair<S::Real>, (a, b): (usize, usize), distance: S::Real) -> S::Real {
    let (volume, excess) = (&state.columns.reference_volume, &state.columns.colour_excess);
    let slope = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION).gradient(distance, S::Real::of(0.5) * pair.range);
    S::Real::of(-1.0) * pair.strength * volume[a] * volume[b] * (excess[a] + excess[b]) * slope
}
