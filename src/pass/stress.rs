//! Advances volumetric strain and deviatoric stress by one step of leapfrog, from the velocity gradient at
//! the middle of the step. Twin: shaders/pass/stress.wgsl
//!
//! The rotation is Cayley's, Q = (1 - A/2)^-1 (1 + A/2) with A = step Omega (Hughes & Winget 1980): exactly
//! orthogonal, where adding step (Omega S - S Omega) as printed in Fuller (2.45) lets S grow by 5 % a turn.
//!
//! Where a body yields, the deviator then returns along itself to the yield surface, S -> (sY/q) S with
//! q = sqrt(3 J2) (Wilkins 1964). Fuller (5.1) as printed lacks the root: sY^2/q^2 takes S below the surface.

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::material::{
    self,
    yielding::{Before, Yielded, yielded},
};
use crate::method::{Density, Gradient};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "advances volumetric strain and deviatoric stress by a step",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[VelocityGradient]),
            when(|m| m.shears() && m.many_bodies, &[Body]),
            when(|m| m.shears(), &[DeviatoricStress]),
            when(|m| m.plastic(), &[EquivalentPlasticStrain]),
            when(|m| m.continuity() || m.plastic(), &[VolumetricStrain]),
            when(|m| m.plastic() && m.heated(), &[Temperature]),
            when(|m| m.plastic() && m.dissipated_energy, &[DissipatedEnergy]),
        ],
        neighbours: &[],
        writes: &[
            when(|m| m.shears(), &[DeviatoricStress]),
            when(|m| m.plastic(), &[EquivalentPlasticStrain]),
            when(|m| m.plastic() && m.heated(), &[Temperature]),
            when(|m| m.plastic() && m.dissipated_energy, &[DissipatedEnergy]),
            when(|m| m.continuity(), &[VolumetricStrain]),
        ],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let step = state.clock.step;
    if state.method.shear {
        fill!(state, deviatoric_stress, |a, slot| {
            let gradient = middle_gradient(state, a);
            let half = material::deviatoric_rate::<S>(state.body(a).shear_modulus, gradient) * (S::Real::of(0.5) * step);
            let rotated = rotate::<S>(*slot + half, S::skew_part(gradient) * step);
            *slot = rotated + half;
        });
    }
    if state.method.plastic() {
        yield_to(state);
    }
    if state.method.density == Density::Continuity {
        fill!(state, volumetric_strain, |a, slot| {
            let growth = S::trace(middle_gradient(state, a)) * step;
            // Crank-Nicolson of J' = J tr L, written for J - 1 so that f32 keeps small strains.
            *slot += (S::Real::of(1.0) + *slot) * growth / (S::Real::of(1.0) - S::Real::of(0.5) * growth);
        });
    }
}

/// Returns stress to the yield surface.
fn yield_to<S: Space>(state: &mut State<S>) {
    let zero = S::Real::of(0.0);
    let none = Yielded { deviator: S::Sym::default(), growth: zero, work: zero };
    let mut returns = vec![none; state.params.count as usize];
    super::write(&mut returns, |a, slot| {
        let columns = &state.columns;
        let before = Before {
            strain: columns.equivalent_plastic_strain[a],
            temperature: columns.temperature.get(a).copied().unwrap_or(zero),
            volume: S::Real::of(1.0) + columns.volumetric_strain[a],
        };
        *slot = yielded::<S>(state.body(a), columns.deviatoric_stress[a], before, state.clock.step);
    });
    for (a, Yielded { deviator, growth, work }) in returns.into_iter().enumerate() {
        let body = *state.body(a);
        let columns = &mut state.columns;
        columns.deviatoric_stress[a] = deviator;
        columns.equivalent_plastic_strain[a] += growth;
        if let Some(temperature) = columns.temperature.get_mut(a) {
            *temperature += material::rise(&body, work);
        }
        if let Some(heat) = columns.dissipated_energy.get_mut(a) {
            *heat += work * (S::Real::of(1.0) / body.density);
        }
    }
}

/// The plain gradient is divided by the density of the step's start; here by that of its middle, without which
/// leapfrog is of first order where strains are finite. 1/rho changes at the rate of the sum itself, so the
/// volume's step comes out exact: J -> J/(1 - step tr L).
#[inline(always)]
fn middle_gradient<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let gradient = state.columns.velocity_gradient[a];
    if state.method.gradient != Gradient::Plain {
        return gradient;
    }
    let one = S::Real::of(1.0);
    gradient * (one / (one - S::Real::of(0.5) * S::trace(gradient) * state.clock.step))
}

/// Q S Q^T with Q = 1 + (A + A A/2)/(1 + |a|^2/4), |a|^2 = A:A/2: Cayley's rotation in closed form.
#[inline(always)]
fn rotate<S: Space>(stress: S::Sym, turn: S::Mat) -> S::Sym {
    let square = S::mat_mat(turn, turn);
    let angle_square = -S::Real::of(0.5) * S::trace(square);
    let scale = S::Real::of(1.0) / (S::Real::of(1.0) + S::Real::of(0.25) * angle_square);
    let q = S::mat_identity() + (turn + square * S::Real::of(0.5)) * scale;
    S::sym_part(S::mat_mat(S::mat_mat(q, S::mat_of_sym(stress)), S::transpose(q)))
}
