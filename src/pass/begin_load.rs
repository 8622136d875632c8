//! Begins a load step: what is held moves by the integral of its prescribed velocity over the load step, what is
//! free goes on as far as between the last two equilibria, and all velocities are set to zero. What plastic bodies
//! remember of the load step before is settled.
//! Twin: shaders/pass/begin_load.wgsl

use super::{Stage, compensated_add};
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut displacement = std::mem::take(&mut state.particles.displacement);
    let mut equilibrium = std::mem::take(&mut state.particles.equilibrium_displacement);
    let mut carry = std::mem::take(&mut state.particles.displacement_carry);
    for (a, (u, before)) in displacement.iter_mut().zip(&mut equilibrium).enumerate() {
        let increment = increment(state, a, *u - *before);
        *before = *u;
        match carry.get_mut(a) {
            Some(carry) => compensated_add::<S>(u, carry, increment),
            None => *u += increment,
        }
    }
    state.particles.displacement = displacement;
    state.particles.equilibrium_displacement = equilibrium;
    state.particles.displacement_carry = carry;
    state.particles.velocity.fill(S::Vec::default());
    if state.method.plastic() {
        let particles = &mut state.particles;
        particles.equilibrium_inelastic_strain.copy_from_slice(&particles.inelastic_strain);
        particles.equilibrium_plastic_strain.copy_from_slice(&particles.equivalent_plastic_strain);
    }
}

/// By how much a particle moves when a load step begins: a free one by its increment over the last load step, a held one by
/// the integral of its prescribed velocity.
#[inline(always)]
fn increment<S: Space>(state: &State<S>, a: usize, mut last: S::Vec) -> S::Vec {
    if state.method.constraints && state.particles.constraint[a] != 0 {
        let constraint = &state.constraints[state.particles.constraint[a] as usize - 1];
        let from = state.clock.start;
        let time = state.course_integral(constraint, from, from + state.clock.duration);
        let vector = [constraint.x, constraint.y, constraint.z];
        for k in 0..S::DIMENSION {
            if constraint.prescribed >> k & 1 == 1 {
                last[k] = vector[k] * time;
            }
        }
    }
    last
}
