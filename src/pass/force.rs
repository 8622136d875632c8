//! Acceleration of each particle, Fuller (2.59) with the viscosity's sign mended:
//!
//! a_a = sum m_b (sigma_a/rho_a^2 + sigma_b/rho_b^2 - Pi_ab + (R_a + R_b) f^n) grad_a W_ab,
//!
//! or, adjoint to the corrected velocity gradient,
//!
//! a_a = (1/rho_a) sum V_b (sigma_a K_a^-1 + sigma_b K_b^-1) grad_a W_ab + the terms of Pi and R as above.
//!
//! Twin: shaders/pass/force.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::method::{ArtificialForm, Gradient};
use crate::pair::{Pair, blocks, mirror_tensor, pair_coupling, velocity_difference};
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "acceleration, Fuller (2.59) with the sign of the viscosity mended",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, Displacement, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.pair_volume(), &[VolumetricStrain]),
            when(|m| m.pair_velocity(), &[Velocity]),
            when(|m| m.adjoint(), &[CorrectedStress]),
            when(|m| !m.adjoint(), &[SpecificStress]),
            when(|m| m.scalar_form(), &[ArtificialPressure]),
            when(|m| m.principal_form(), &[ArtificialStress]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.pair_volume(), &[VolumetricStrain]),
            when(|m| m.pair_velocity(), &[Velocity]),
            when(|m| m.adjoint(), &[CorrectedStress]),
            when(|m| !m.adjoint(), &[SpecificStress]),
            when(|m| m.scalar_form(), &[ArtificialPressure]),
            when(|m| m.principal_form(), &[ArtificialStress]),
        ],
        writes: &[
            always(&[Acceleration]),
            when(|m| m.internal_energy, &[InternalPower]),
            when(|m| m.dissipated_power(), &[DissipatedPower]),
        ],
    }
};

/// What the sum over neighbours gives.
#[derive(Clone, Copy)]
struct Sums<S: Space> {
    acceleration: S::Vec,
    internal_power: S::Real,
    dissipated_power: S::Real,
}

impl<S: Space> Default for Sums<S> {
    fn default() -> Self {
        let zero = S::Real::of(0.0);
        Self { acceleration: S::Vec::default(), internal_power: zero, dissipated_power: zero }
    }
}

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if !(state.method.internal_energy || state.method.dissipated_power()) {
        fill!(state, acceleration, |a, slot| *slot = sum(state, a).acceleration);
        return;
    }
    let mut sums = vec![Sums::<S>::default(); state.params.count as usize];
    super::write(&mut sums, |a, slot| *slot = sum(state, a));
    for (a, sum) in sums.iter().enumerate() {
        state.columns.acceleration[a] = sum.acceleration;
        if state.method.internal_energy {
            state.columns.internal_power[a] = sum.internal_power;
        }
        if state.method.dissipated_power() {
            state.columns.dissipated_power[a] = sum.dissipated_power;
        }
    }
}

#[inline(always)]
fn sum<S: Space>(state: &State<S>, a: usize) -> Sums<S> {
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let method = &state.method;
    let half = S::Real::of(0.5);
    let own = state.columns.specific_stress.get(a).copied().unwrap_or_default();
    let mut sums = Sums::default();
    for block in blocks(state, a) {
        let weights = if method.artificial_stress.is_some() { block.weights(&kernel) } else { Default::default() };
        for (pair, weight) in block.pairs().zip(weights) {
            let mass = state.mass(pair.b) * pair_coupling(state, a, pair.b);
            let gradient = pair.x * pair.gradient;
            let mut force = if method.gradient == Gradient::Adjoint {
                let weight = state.volume(pair.b) * pair_coupling(state, a, pair.b) / state.density(a);
                S::mat_vec(corrected_stress(state, a, &pair), gradient) * weight
            } else {
                specific_stress(state, own, &pair, gradient) * mass
            };
            if method.artificial_stress.is_some() {
                let weight = weight / state.params.artificial_weight;
                force += artificial_stress(state, a, &pair, gradient) * (mass * power(weight, state.params.artificial_exponent));
            }
            let mut friction = S::Vec::default();
            if method.viscosity {
                friction = gradient * (-mass * viscosity(state, a, &pair));
                force += friction;
            }
            sums.acceleration += force;
            if method.internal_energy || method.dissipated_power() {
                let v_ba = velocity_difference(state, a, &pair);
                sums.internal_power += half * S::inner(v_ba, force);
                sums.dissipated_power += half * S::inner(v_ba, friction);
            }
        }
    }
    sums
}

/// (sigma_a/rho_a^2 + sigma_b/rho_b^2) grad_a W_ab
#[inline(always)]
fn specific_stress<S: Space>(state: &State<S>, own: S::Sym, pair: &Pair<S>, gradient: S::Vec) -> S::Vec {
    let stress = &state.columns.specific_stress;
    if pair.image == 0 {
        return S::sym_vec(own + stress[pair.b], gradient);
    }
    let image = mirror_tensor::<S>(&state.params, pair.image, S::mat_of_sym(stress[pair.b]));
    S::sym_vec(own, gradient) + S::mat_vec(image, gradient)
}

/// sigma_a K_a^-1 + sigma_b K_b^-1
#[inline(always)]
fn corrected_stress<S: Space>(state: &State<S>, a: usize, pair: &Pair<S>) -> S::Mat {
    let stress = &state.columns.corrected_stress;
    if pair.image == 0 {
        return stress[a] + stress[pair.b];
    }
    stress[a] + mirror_tensor::<S>(&state.params, pair.image, stress[pair.b])
}

/// (R_a + R_b) grad_a W_ab
#[inline(always)]
fn artificial_stress<S: Space>(state: &State<S>, a: usize, pair: &Pair<S>, gradient: S::Vec) -> S::Vec {
    let columns = &state.columns;
    if state.method.artificial_stress == Some(ArtificialForm::Scalar) {
        return gradient * (columns.artificial_pressure[a] + columns.artificial_pressure[pair.b]);
    }
    let stress = &columns.artificial_stress;
    if pair.image == 0 {
        return S::sym_vec(stress[a] + stress[pair.b], gradient);
    }
    let image = mirror_tensor::<S>(&state.params, pair.image, S::mat_of_sym(stress[pair.b]));
    S::mat_vec(S::mat_of_sym(stress[a]) + image, gradient)
}

/// Pi_ab of Monaghan, Fuller (2.60): only while the two approach.
#[inline(always)]
fn viscosity<S: Space>(state: &State<S>, a: usize, pair: &Pair<S>) -> S::Real {
    let params = &state.params;
    let approach = -S::inner(velocity_difference(state, a, pair), pair.x);
    let square = pair.distance * pair.distance + params.softening * pair.h * pair.h;
    let mu = (pair.h * approach / square).min(S::Real::of(0.0));
    let half = S::Real::of(0.5);
    let sound_speed = half * (state.body(a).sound_speed + state.body(pair.b).sound_speed);
    let density = half * (state.density(a) + state.density(pair.b));
    let (alpha, beta) = viscosities(state, a, pair.b);
    (beta * mu - alpha * sound_speed) * mu / density
}

/// alpha and beta of a pair. Where bodies differ they are the means of the two particles' numbers, so that both feel the
/// same Pi and momentum is kept.
#[inline(always)]
fn viscosities<S: Space>(state: &State<S>, a: usize, b: usize) -> (S::Real, S::Real) {
    if !state.method.body_options {
        return (state.params.alpha, state.params.beta);
    }
    let half = S::Real::of(0.5);
    (half * (state.alpha(a) + state.alpha(b)), half * (state.beta(a) + state.beta(b)))
}

/// Small whole powers, without the cost of a general one.
#[inline(always)]
fn power<R: Real>(base: R, exponent: u32) -> R {
    let mut product = R::of(1.0);
    for _ in 0..exponent {
        product = product * base;
    }
    product
}
