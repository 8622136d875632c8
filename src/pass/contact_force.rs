//! Adds the acceleration by contact, m_a a_a += sum strength/range (-phi'(r/range)) x_ab/r, and finds each
//! particle's half of the pairs' energy. Twin: shaders/pass/contact_force.wgsl

use super::Stage;
use crate::pair::separation;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let Some(potential) = state.method.contact.filter(|_| state.clock.running == 1) else { return };
    let mut accelerations = std::mem::take(&mut state.particles.acceleration);
    let mut energies = std::mem::take(&mut state.particles.contact_energy);
    let count = state.params.count as usize;
    for a in 0..count {
        energies[a] = S::Real::of(0.0);
        let listed = state.particles.contact_count[a] as usize;
        if listed == 0 {
            continue;
        }
        let mut force = S::Vec::default();
        for k in 0..listed {
            let b = state.contacts[k * count + a];
            let pair = state.contact_pair(a, b as usize);
            let x = separation(state, a, b);
            let distance = S::inner(x, x).sqrt();
            if distance < pair.range {
                let (energy, slope) = potential.at(distance / pair.range);
                energies[a] += S::Real::of(0.5) * pair.strength * energy;
                force += x * (pair.strength * slope / (pair.range * distance));
            }
        }
        accelerations[a] += force * (S::Real::of(1.0) / state.mass(a));
    }
    state.particles.acceleration = accelerations;
    state.particles.contact_energy = energies;
}
