//! Ends a step: advances the clock, finds the next step, whether the neighbour list still holds, and faults.
//! Twin: shaders/pass/bound_time_step.wgsl
//!
//! step = cfl min(h/(c (1 + 0.6 alpha) + 0.6 beta h |tr L|), sqrt(h/|a|)), Monaghan 1992. At finite strain c is that of the
//! present deformation, and the step never longer than the integrator bears at the body's highest frequency.
//!
//! A segment is parted into equal steps: one that swings in time with the outputs feeds the fastest oscillations of an
//! integrator that keeps energy. At finite strain the step is held until the bound falls below it.

use super::Stage;
use super::declaration::{Declaration, Domain, Entry, Runs, always, when};
use super::write::fill;
use crate::fields::REDUCTION_BLOCK;
use crate::material;
use crate::rows::{Fault, Params};
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
            when(|m| m.contact.stiffens(), &[ContactRate]),
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
    let mut waves = signal / h;
    if finite_strain && params.stable > zero {
        let stiffening = material::stiffening::<S>(body, columns.displacement_gradient[a]);
        waves = waves.max(params.cfl / params.stable * body.frequency * (one + part * params.alpha));
        waves = waves * stiffening.max(one).min(S::Real::of(STIFFEST)).sqrt();
    }
    let mut rate = waves.max((pull.sqrt() / h).sqrt());
    if state.method.facets() {
        rate = (rate * rate + params.contact_rate).sqrt();
    }
    if state.method.contact.stiffens() {
        rate = (rate * rate + columns.contact_rate[a]).sqrt();
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
    let (listed_once, holds) = (!state.method.listed_again(), state.method.finite_strain());
    let (params, clock) = (&state.params, &mut state.clock);
    // The first call of a segment comes before any step: it advances no clock and only finds the first step.
    let (before, zero) = (clock.step, S::Real::of(0.0));
    if before > zero {
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
    // A remainder below this is the rounding error of the sum of steps, not time that is left.
    let arrived = left <= S::Real::of(1e-4) * before;
    clock.arrived = if before > zero { u32::from(arrived) } else { clock.arrived };
    if clock.fault != 0 || clock.steps_left == 0 || arrived {
        clock.running = 0;
        return;
    }
    let longest = if params.fixed_step > zero { params.fixed_step } else { params.cfl / bound[0] };
    let held = if before > zero || clock.arrived == 0 { clock.held } else { zero };
    clock.step = if params.fixed_step > zero {
        fixed(left, longest)
    } else if holds && held > zero && held <= S::Real::of(SLACK) * longest {
        // In groups the step of another may have been taken: then what is left is no multiple of it.
        parted(left, -(S::Real::of(0.01) - left / held).floor())
    } else {
        let longest = if holds { rung(params, longest) } else { longest };
        parted(left, parts(left, params.interval, longest))
    };
    if (clock.step - clock.held).abs() > S::Real::of(0.01) * clock.held && clock.held > zero {
        clock.changes += 1;
    }
    clock.held = clock.step;
    let ahead = bound[1].sqrt() + bound[2].sqrt() * clock.step;
    clock.rebuild = u32::from(!listed_once && ahead > params.slack);
}

/// Stiffening beyond which steps grow no shorter: a body squeezed so far collapses, and its run shall end with a fault instead of
/// standing almost still.
const STIFFEST: f64 = 1e4;
/// By what part a held step may be above its bound.
const SLACK: f64 = 1.05;
/// Ratio of the lengths from which a step that is held is chosen, 2^(-1/4).
const RUNG: f64 = 0.840_896_415_253_714_6;

/// The step that is asked for, or the time that is left if that is less.
fn fixed<R: Real>(left: R, step: R) -> R {
    if left <= step * R::of(1.00001) { left } else { step }
}

/// A part of the time that is left; all of it if it is in no more than one.
fn parted<R: Real>(left: R, parts: R) -> R {
    if parts > R::of(1.5) { left / parts } else { left }
}

/// The longest of the lengths that a held step has, of which one is that of the unstressed bodies: a bound that moves a little
/// from output to output then leaves the step as it is.
fn rung<R: Real>(params: &Params<R>, longest: R) -> R {
    let mut step = params.rest_step;
    if step <= R::of(0.0) {
        return longest;
    }
    for _ in 0..200 {
        if step <= R::of(SLACK) * longest {
            return step;
        }
        step = step * R::of(RUNG);
    }
    longest
}

/// In how many steps to go what is left: as many from output to output as everywhere else, where outputs have a time in
/// common that is not much shorter than a step.
fn parts<R: Real>(left: R, interval: R, longest: R) -> R {
    let whole = |x: R| -(-x + R::of(1e-5)).floor();
    let intervals = if interval > R::of(0.5) * longest { (left / interval).round() } else { R::of(0.0) };
    if intervals > R::of(0.5) && (left - intervals * interval).abs() < R::of(1e-4) * interval {
        return intervals * whole(interval / longest).max(R::of(1.0));
    }
    whole(left / longest)
}
