//! v += part step a, then the boundary conditions. Twin: shaders/pass/kick.wgsl

use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::{fill, with_columns};
use super::{Stage, compensated_add};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "advances the velocity by a part of the step",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[Velocity, Acceleration]),
            when(|m| m.constraints, &[Constraint]),
            when(|m| m.internal_energy, &[InternalEnergy, InternalPower]),
            when(|m| m.dissipated_power(), &[DissipatedEnergy, DissipatedPower]),
            when(|m| m.compensated, &[VelocityCarry]),
        ],
        neighbours: &[],
        writes: &[
            always(&[Velocity]),
            when(|m| m.compensated, &[VelocityCarry]),
            when(|m| m.internal_energy, &[InternalEnergy]),
            when(|m| m.dissipated_power(), &[DissipatedEnergy]),
        ],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    let part = S::Real::of(stage.part) * state.clock.step;
    let time = state.clock.start + state.clock.elapsed + S::Real::of(stage.time) * state.clock.step;
    let before = if state.method.internal_energy { state.columns.velocity.clone() } else { Vec::new() };
    if state.method.compensated {
        with_columns!(state, [velocity, velocity_carry] => {
            for (a, (v, c)) in velocity.iter_mut().zip(&mut velocity_carry).enumerate() {
                compensated_add::<S>(v, c, acceleration(state, a, time) * part);
                *v = prescribe(state, a, *v, time);
            }
        });
    } else {
        fill!(state, velocity, |a, v| {
            *v += acceleration(state, a, time) * part;
            *v = prescribe(state, a, *v, time);
        });
    }
    add_energy(state, part, &before, stage);
}

/// Acceleration by neighbours, by the body force and by a prescribed force.
#[inline(always)]
pub fn acceleration<S: Space>(state: &State<S>, a: usize, time: S::Real) -> S::Vec {
    let params = &state.params;
    let mut sum = state.columns.acceleration[a];
    if state.method.body_force {
        let g = [params.body_force_x, params.body_force_y, params.body_force_z];
        for k in 0..S::DIMENSION {
            sum[k] += g[k];
        }
    }
    if state.method.constraints && state.columns.constraint[a] != 0 {
        let constraint = &state.constraints[state.columns.constraint[a] as usize - 1];
        let factor = state.course_factor(constraint, time);
        let vector = [constraint.x, constraint.y, constraint.z];
        for k in 0..S::DIMENSION {
            if constraint.prescribed >> k & 1 == 0 {
                sum[k] += vector[k] * factor;
            }
        }
    }
    sum
}

/// Replaces the components of a velocity that a boundary condition prescribes.
#[inline(always)]
pub fn prescribe<S: Space>(state: &State<S>, a: usize, mut v: S::Vec, time: S::Real) -> S::Vec {
    if state.method.constraints && state.columns.constraint[a] != 0 {
        let constraint = &state.constraints[state.columns.constraint[a] as usize - 1];
        let factor = state.course_factor(constraint, time);
        let vector = [constraint.x, constraint.y, constraint.z];
        for k in 0..S::DIMENSION {
            if constraint.prescribed >> k & 1 == 1 {
                v[k] = vector[k] * factor;
            }
        }
    }
    v
}

/// Energies grow at the same two moments as the velocity, with the force of that moment.
///
/// The force found its power with the velocity of the half step, while the kick does its work at the mean of
/// the velocities before and after: half a kick later in the second half, one and a half in the first. With
/// the difference added, kinetic and internal energy sum to a constant.
fn add_energy<S: Space>(state: &mut State<S>, part: S::Real, before: &[S::Vec], stage: Stage) {
    let later = S::Real::of(kicks_later(stage));
    let columns = &mut state.columns;
    for (a, energy) in columns.internal_energy.iter_mut().enumerate() {
        let change = (columns.velocity[a] - before[a]) * later;
        *energy += (columns.internal_power[a] - S::inner(columns.acceleration[a], change)) * part;
    }
    for (energy, power) in columns.dissipated_energy.iter_mut().zip(&columns.dissipated_power) {
        *energy += *power * part;
    }
}

/// Time from the velocity that the force used to the middle of this kick, in units of one kick.
fn kicks_later(stage: Stage) -> f64 {
    if stage.time < 1.0 { 1.5 } else { 0.5 }
}
