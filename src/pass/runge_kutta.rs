//! One stage: sum += weight rate, then state = start + step (of_sum sum + of_rate rate).
//! Twin: shaders/pass/runge_kutta.wgsl
//!
//! Rates are summed, not states, so that f32 adds small numbers to small numbers until the last stage.

use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::drift::moving_velocity;
use super::kick::{acceleration, prescribe};
use super::{Stage, compensated_add};
use crate::state::State;
use crate::tensor::{Linear, Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "adds a stage's rates and sets the next stage's state",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[Displacement, Velocity, Acceleration, DisplacementStart, VelocityStart, DisplacementSum, VelocitySum]),
            when(|m| m.xsph, &[SmoothedVelocity]),
            when(|m| m.constraints, &[Constraint]),
            when(|m| m.shears(), &[DeviatoricStress, DeviatoricStressRate, DeviatoricStressStart, DeviatoricStressSum]),
            when(|m| m.continuity(), &[VolumetricStrain, VolumetricStrainRate, VolumetricStrainStart, VolumetricStrainSum]),
            when(
                |m| m.evolved(),
                &[DisplacementGradient, DisplacementGradientRate, DisplacementGradientStart, DisplacementGradientSum],
            ),
            when(|m| m.internal_energy, &[InternalEnergy, InternalPower, InternalEnergyStart, InternalEnergySum]),
            when(|m| m.dissipated_power(), &[DissipatedEnergy, DissipatedPower, DissipatedEnergyStart, DissipatedEnergySum]),
            when(|m| m.compensated, &[DisplacementCarry, VelocityCarry]),
        ],
        neighbours: &[],
        writes: &[
            always(&[Displacement, Velocity, DisplacementStart, VelocityStart, DisplacementSum, VelocitySum]),
            when(|m| m.compensated, &[DisplacementCarry, VelocityCarry]),
            when(|m| m.shears(), &[DeviatoricStress, DeviatoricStressStart, DeviatoricStressSum]),
            when(|m| m.continuity(), &[VolumetricStrain, VolumetricStrainStart, VolumetricStrainSum]),
            when(|m| m.evolved(), &[DisplacementGradient, DisplacementGradientStart, DisplacementGradientSum]),
            when(|m| m.internal_energy, &[InternalEnergy, InternalEnergyStart, InternalEnergySum]),
            when(|m| m.dissipated_power(), &[DissipatedEnergy, DissipatedEnergyStart, DissipatedEnergySum]),
        ],
    }
};

/// Advances one column whose rate is another.
fn advance<R: Real, T: Linear<R>>(
    column: &mut [T],
    start: &mut [T],
    sum: &mut [T],
    rate: impl Fn(usize) -> T,
    step: R,
    stage: Stage,
) {
    for a in 0..column.len() {
        column[a] = next(column[a], &mut start[a], &mut sum[a], rate(a), step, stage).0;
    }
}

/// Next state and its increment over the start.
fn next<R: Real, T: Linear<R>>(now: T, start: &mut T, sum: &mut T, rate: T, step: R, stage: Stage) -> (T, T) {
    if stage.first {
        *start = now;
        *sum = T::default();
    }
    *sum += rate * R::of(stage.weight);
    let increment = (*sum * R::of(stage.of_sum) + rate * R::of(stage.of_rate)) * step;
    (*start + increment, increment)
}

/// [`advance`] for a column of scalars.
fn advance_scalar<R: Real>(column: &mut [R], start: &mut [R], sum: &mut [R], rate: &[R], step: R, stage: Stage) {
    use crate::tensor::Tuple;
    for a in 0..column.len() {
        let (mut s, mut r) = (Tuple([start[a]]), Tuple([sum[a]]));
        column[a] = next(Tuple([column[a]]), &mut s, &mut r, Tuple([rate[a]]), step, stage).0.0[0];
        (start[a], sum[a]) = (s.0[0], r.0[0]);
    }
}

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    let step = state.clock.step;
    motion(state, stage);
    let p = &mut state.columns;
    let stress_rate = &p.deviatoric_stress_rate;
    advance(
        &mut p.deviatoric_stress,
        &mut p.deviatoric_stress_start,
        &mut p.deviatoric_stress_sum,
        |a| stress_rate[a],
        step,
        stage,
    );
    // These columns are empty unless the deformation gradient is integrated as a state of its own.
    if !p.displacement_gradient_rate.is_empty() {
        let rate = &p.displacement_gradient_rate;
        advance(
            &mut p.displacement_gradient,
            &mut p.displacement_gradient_start,
            &mut p.displacement_gradient_sum,
            |a| rate[a],
            step,
            stage,
        );
    }
    if !p.volumetric_strain_rate.is_empty() {
        advance_scalar(
            &mut p.volumetric_strain,
            &mut p.volumetric_strain_start,
            &mut p.volumetric_strain_sum,
            &p.volumetric_strain_rate,
            step,
            stage,
        );
    }
    advance_scalar(
        &mut p.internal_energy,
        &mut p.internal_energy_start,
        &mut p.internal_energy_sum,
        &p.internal_power,
        step,
        stage,
    );
    advance_scalar(
        &mut p.dissipated_energy,
        &mut p.dissipated_energy_start,
        &mut p.dissipated_energy_sum,
        &p.dissipated_power,
        step,
        stage,
    );
}

/// Displacement and velocity; the rate of the displacement is the velocity before this stage changes it.
fn motion<S: Space>(state: &mut State<S>, stage: Stage) {
    let step = state.clock.step;
    let now = state.clock.start + state.clock.elapsed;
    let (time, next_time) = (now, now + S::Real::of(stage.time) * step);
    for a in 0..state.params.count as usize {
        let rates = (moving_velocity(state, a), acceleration(state, a, time));
        let p = &mut state.columns;
        let (u, du) = next(p.displacement[a], &mut p.displacement_start[a], &mut p.displacement_sum[a], rates.0, step, stage);
        let (v, dv) = next(p.velocity[a], &mut p.velocity_start[a], &mut p.velocity_sum[a], rates.1, step, stage);
        (p.displacement[a], p.velocity[a]) = (u, v);
        if stage.last && state.method.compensated {
            (p.displacement[a], p.velocity[a]) = (p.displacement_start[a], p.velocity_start[a]);
            compensated_add::<S>(&mut p.displacement[a], &mut p.displacement_carry[a], du);
            compensated_add::<S>(&mut p.velocity[a], &mut p.velocity_carry[a], dv);
        }
        state.columns.velocity[a] = prescribe(state, a, state.columns.velocity[a], next_time);
    }
}
