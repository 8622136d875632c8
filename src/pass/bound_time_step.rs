//! Ends a step: advances the clock, finds the next step, whether the neighbour list still holds, and faults.
//! Twin: shaders/pass/bound_time_step.wgsl
//!
//! step = cfl min(h/(c (1 + 0.6 alpha) + 0.6 beta h |tr L|), sqrt(h/|a|)), Monaghan 1992.

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
        about: "advances the clock; finds the next step, whether the list still holds, and faults",
        entries: &[Entry::new("blocks", Domain::ReductionBlocks), Entry::new("advance", Domain::One)],
        runs: Runs::Running,
        own: &[
            always(&[Velocity, Acceleration, BlockBound]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.listed_again(), &[Displacement, ListedDisplacement]),
            when(|m| m.finite_strain(), &[DisplacementGradient]),
            when(|m| !m.finite_strain(), &[VolumetricStrain, VelocityGradient]),
        ],
        neighbours: &[],
        writes: &[always(&[BlockBound])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let bound = largest(state, bound_of);
    clock(state, bound);
}

/// The largest of each of four numbers over all particles.
pub(super) fn largest<S: Space>(state: &mut State<S>, of: fn(&State<S>, usize) -> [S::Real; 4]) -> [S::Real; 4] {
    fill!(state, block_bound, |block, slot| {
        let first = block * REDUCTION_BLOCK;
        let last = (first + REDUCTION_BLOCK).min(state.params.count as usize);
        *slot = (first..last).fold([S::Real::of(0.0); 4], |bound, a| larger(bound, of(state, a)));
    });
    state.columns.block_bound.iter().fold([S::Real::of(0.0); 4], |bound, &block| larger(bound, block))
}

#[inline(always)]
fn larger<R: Real>(a: [R; 4], b: [R; 4]) -> [R; 4] {
    [a[0].max(b[0]), a[1].max(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

/// Rate, squared displacement since the list was built, squared speed, fault of one particle.
fn bound_of<S: Space>(state: &State<S>, a: usize) -> [S::Real; 4] {
    let (columns, params, body) = (&state.columns, &state.params, state.body(a));
    let (h, part) = (state.smoothing_length(a), S::Real::of(0.6));
    let (one, zero) = (S::Real::of(1.0), S::Real::of(0.0));
    let finite_strain = state.method.finite_strain();
    let compression = if finite_strain { zero } else { S::trace(columns.velocity_gradient[a]).abs() };
    let signal = body.sound_speed * (one + part * params.alpha) + part * params.beta * h * compression;
    let pull = S::inner(columns.acceleration[a], columns.acceleration[a]);
    let mut rate = (signal / h).max((pull.sqrt() / h).sqrt());
    if state.method.facets() {
        rate = (rate * rate + params.contact_rate).sqrt();
    }
    let moved = columns.listed_displacement.get(a).map_or(S::Vec::default(), |listed| columns.displacement[a] - *listed);
    let (moved, speed) = (S::inner(moved, moved), S::inner(columns.velocity[a], columns.velocity[a]));
    let volume = if finite_strain {
        S::determinant(S::mat_identity() + columns.displacement_gradient[a])
    } else {
        one + columns.volumetric_strain[a]
    };
    let finite = (pull + moved + speed + compression).is_finite();
    let fault = if !finite {
        S::Real::of(f64::from(Fault::NotFinite as u32))
    } else if volume <= zero {
        S::Real::of(f64::from(Fault::Inverted as u32))
    } else {
        zero
    };
    [rate, moved, speed, fault]
}

fn clock<S: Space>(state: &mut State<S>, bound: [S::Real; 4]) {
    let listed_once = !state.method.listed_again();
    let (params, clock) = (&state.params, &mut state.clock);
    // The first call of a segment comes before any step: it advances no clock and only finds the first step.
    if clock.step > S::Real::of(0.0) {
        let corrected = clock.step - clock.elapsed_carry;
        let total = clock.elapsed + corrected;
        clock.elapsed_carry = (total - clock.elapsed) - corrected;
        clock.elapsed = total;
        clock.steps_left -= 1;
        clock.steps_done += 1;
    }
    clock.lists_built = if listed_once { 1 } else { clock.lists_built + clock.rebuild };
    if clock.fault == 0 {
        clock.fault = bound[3].f64() as u32;
    }
    let left = clock.duration - clock.elapsed;
    let step = if params.fixed_step > S::Real::of(0.0) { params.fixed_step } else { params.cfl / bound[0] };
    // A remainder below this is the rounding error of the sum of steps, not time that is left.
    let nothing = S::Real::of(1e-5) * step;
    if clock.fault != 0 || clock.steps_left == 0 || left <= nothing {
        clock.running = 0;
        return;
    }
    // The last two steps share the time that is left, so that the last one is not much shorter than the others.
    clock.step = if left <= step * S::Real::of(1.00001) {
        left
    } else if left < S::Real::of(2.0) * step && params.fixed_step == S::Real::of(0.0) {
        left * S::Real::of(0.5)
    } else {
        step
    };
    let ahead = bound[1].sqrt() + bound[2].sqrt() * clock.step;
    clock.rebuild = u32::from(!listed_once && ahead > params.slack);
}
