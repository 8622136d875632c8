//! Ends a step of the descent to equilibrium: how far the particles are from it, and how the next step goes.
//! Twin: shaders/pass/bound_residual.wgsl
//!
//! Residual: the largest out-of-balance force on what is free, over the force scale max E (V/h) max(|e|, 1e-6), e
//! Green's strain. The scale is a force that a particle's bonds carry: it knows no rigid turn, follows the load
//! down, and the floor keeps it from zero where there is none. Masses weigh the sums, so that FIRE turns
//! momenta, not velocities, where bodies differ in density.
//!
//! In f32 differences of the displacement u hold strains to about 6e-8 |u|/spacing: large displacements of thin
//! bodies ask for f64.

mod descent;

use super::Stage;
use super::declaration::{Declaration, Domain, Entry, Runs, always, when};
use super::write::fill;
use crate::fields::REDUCTION_BLOCK;
use crate::rows::Fault;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "finds how far from equilibrium the particles are, and how to go on",
        entries: &[Entry::new("blocks", Domain::ReductionBlocks), Entry::new("advance", Domain::One)],
        runs: Runs::Running,
        own: &[
            always(&[ReferenceVolume, Velocity, Acceleration, DisplacementGradient, BlockResidual]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.constraints, &[Constraint]),
        ],
        neighbours: &[],
        writes: &[always(&[BlockResidual])],
    }
};

/// Four sums, m a.v, m a^2, m v^2 and an unused one, and four maxima: force, force scale, rate c/h and fault.
type Measure<R> = [R; 8];

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let nothing = [S::Real::of(0.0); 8];
    fill!(state, block_residual, |block, slot| {
        let first = block * REDUCTION_BLOCK;
        let last = (first + REDUCTION_BLOCK).min(state.params.count as usize);
        *slot = (first..last).fold(nothing, |whole, a| joined(whole, measure(state, a)));
    });
    let whole = state.columns.block_residual.iter().fold(nothing, |whole, &block| joined(whole, block));
    descent::go_on(state, whole);
}

#[inline(always)]
fn joined<R: Real>(a: Measure<R>, b: Measure<R>) -> Measure<R> {
    std::array::from_fn(|k| if k < 4 { a[k] + b[k] } else { a[k].max(b[k]) })
}

#[inline(always)]
fn measure<S: Space>(state: &State<S>, a: usize) -> Measure<S::Real> {
    let (columns, body, mass) = (&state.columns, state.body(a), state.mass(a));
    let (velocity, pull) = (columns.velocity[a], unbalanced(state, a));
    let (square, zero) = (S::inner(pull, pull), S::Real::of(0.0));
    let (power, motion) = (mass * S::inner(pull, velocity), mass * S::inner(velocity, velocity));
    let gradient = columns.displacement_gradient[a];
    let fault = if !(square + motion).is_finite() {
        S::Real::of(f64::from(Fault::NotFinite as u32))
    } else if S::determinant(S::mat_identity() + gradient) <= zero {
        S::Real::of(f64::from(Fault::Inverted as u32))
    } else {
        zero
    };
    let mut rate = body.sound_speed / state.smoothing_length(a);
    if state.method.facets() {
        rate = (rate * rate + state.params.contact_rate).sqrt();
    }
    [power, mass * square, motion, zero, mass * square.sqrt(), force_scale(state, a), rate, fault]
}

/// E (V/h) max(|e|, 1e-6), e = (H + H^T + H^T H)/2.
#[inline(always)]
pub fn force_scale<S: Space>(state: &State<S>, a: usize) -> S::Real {
    let (body, h) = (state.body(a), state.columns.displacement_gradient[a]);
    let strain = S::sym_part(h) + S::sym_part(S::mat_mat(S::transpose(h), h)) * S::Real::of(0.5);
    let strain = S::mat_of_sym(strain);
    let size = S::trace(S::mat_mat(strain, strain)).sqrt();
    let stiffness = body.youngs_modulus * state.columns.reference_volume[a] / state.smoothing_length(a);
    stiffness * size.max(S::Real::of(1e-6))
}

/// Acceleration of what is free, by the bonds and by the loads of the present load step; zero where it is held.
#[inline(always)]
pub fn unbalanced<S: Space>(state: &State<S>, a: usize) -> S::Vec {
    let (params, mut sum) = (&state.params, state.columns.acceleration[a]);
    let time = state.clock.start + state.clock.duration;
    let part = time * params.load_rate;
    if state.method.body_force {
        let g = [params.body_force_x, params.body_force_y, params.body_force_z];
        for k in 0..S::DIMENSION {
            sum[k] += g[k] * part;
        }
    }
    if state.method.constraints && state.columns.constraint[a] != 0 {
        let constraint = &state.constraints[state.columns.constraint[a] as usize - 1];
        let factor = if constraint.course_count == 0 { part } else { state.course_factor(constraint, time) };
        let vector = [constraint.x, constraint.y, constraint.z];
        for k in 0..S::DIMENSION {
            let held = constraint.prescribed >> k & 1 == 1;
            sum[k] = if held { S::Real::of(0.0) } else { sum[k] + vector[k] * factor };
        }
    }
    sum
}
