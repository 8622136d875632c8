//! Begins a load step: what is held moves by the integral of its prescribed velocity over the load step, what is
//! free goes on as far as between the last two equilibria, and all velocities are set to zero. What plastic bodies
//! remember of the load step before is settled.
//! Twin: shaders/pass/begin_load.wgsl

use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::with_columns;
use super::{Stage, compensated_add};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "moves what is held by a load step, and predicts the rest",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[Displacement, EquilibriumDisplacement]),
            when(|m| m.plastic(), &[InelasticStrain, EquivalentPlasticStrain]),
            when(|m| m.constraints, &[Constraint]),
            when(|m| m.compensated, &[DisplacementCarry]),
        ],
        neighbours: &[],
        writes: &[
            always(&[Displacement, Velocity, EquilibriumDisplacement]),
            when(|m| m.compensated, &[DisplacementCarry]),
            when(|m| m.plastic(), &[EquilibriumInelasticStrain, EquilibriumPlasticStrain]),
        ],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_columns!(state, [displacement, equilibrium_displacement, displacement_carry] => {
        for (a, (u, before)) in displacement.iter_mut().zip(&mut equilibrium_displacement).enumerate() {
            let increment = increment(state, a, *u - *before);
            *before = *u;
            match displacement_carry.get_mut(a) {
                Some(carry) => compensated_add::<S>(u, carry, increment),
                None => *u += increment,
            }
        }
    });
    state.columns.velocity.fill(S::Vec::default());
    if state.method.plastic() {
        let columns = &mut state.columns;
        columns.equilibrium_inelastic_strain.copy_from_slice(&columns.inelastic_strain);
        columns.equilibrium_plastic_strain.copy_from_slice(&columns.equivalent_plastic_strain);
    }
}

/// By how much a particle moves when a load step begins: a free one by its increment over the last load step, a held one by
/// the integral of its prescribed velocity.
#[inline(always)]
fn increment<S: Space>(state: &State<S>, a: usize, mut last: S::Vec) -> S::Vec {
    if state.method.constraints && state.columns.constraint[a] != 0 {
        let constraint = &state.constraints[state.columns.constraint[a] as usize - 1];
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
