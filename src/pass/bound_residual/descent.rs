//! What the next step of the descent does, from the sums over all particles.
//!
//! FIRE (Bitzek, Koskinen, Gaehler, Moseler & Gumbsch 2006, with their constants): v turns to the direction of the
//! force, and the step grows while the power F.v is positive; else the particles stop and the step is halved. The
//! kick comes before the drift, and a stop takes half a step back (Guenole et al. 2020).
//! Twin: shaders/lib/descent.wgsl
//!
//! Kinetic damping (Cundall 1982): free motion, stopped where the kinetic energy would fall, half a step back.

use super::Measure;
use crate::method::Descent;
use crate::rows::{Balance, Clock, Fault};
use crate::state::State;
use crate::tensor::{Real, Space};

const START_MIXING: f64 = 0.1;
const LESS_MIXING: f64 = 0.99;
const LONGER: f64 = 1.1;
const SHORTER: f64 = 0.5;
/// Steps downhill after which the step grows.
const PATIENCE: u32 = 5;
/// Length of the first step, and of the shortest one, over the longest stable step.
const FIRST_STEP: f64 = 0.25;
const SHORTEST_STEP: f64 = 0.02;

pub fn go_on<S: Space>(state: &mut State<S>, measure: Measure<S::Real>) {
    let (real, zero) = (S::Real::of, S::Real::of(0.0));
    let listed_again = state.method.listed_again();
    let (params, clock, method) = (&state.params, &mut state.clock, state.method.quasi_static);
    // The first call of a segment comes before any step: it sets the first step and counts none.
    if clock.step > zero {
        clock.steps_left -= 1;
        clock.steps_done += 1;
    } else {
        let longest = params.cfl / measure[6];
        state.balance = Balance { mixing: real(START_MIXING), longest, ..Balance::default() };
        clock.step = if method == Some(Descent::Fire) { real(FIRST_STEP) * longest } else { longest };
    }
    // Contacts are listed anew at each step: a descent goes far, and the search costs less than the forces.
    clock.lists_built += clock.rebuild;
    clock.rebuild = u32::from(listed_again);
    clock.residual = measure[4] / measure[5];
    if end(clock, measure[7].f64() as u32, params.residual) {
        clock.running = 0;
    } else if method == Some(Descent::Fire) {
        fire(&mut state.balance, &mut clock.step, &measure);
    } else {
        damp(&mut state.balance, clock.step, &measure);
    }
}

/// Whether the load step is over, for good or ill.
fn end<R: Real>(clock: &mut Clock<R>, fault: u32, residual: R) -> bool {
    if clock.fault == 0 {
        clock.fault = fault;
    }
    if clock.fault != 0 || clock.duration == R::of(0.0) {
        return true;
    }
    if clock.residual <= residual {
        clock.elapsed = clock.duration;
        return true;
    }
    if clock.steps_left == 0 {
        clock.fault = Fault::NoEquilibrium as u32;
    }
    clock.steps_left == 0
}

fn stop<R: Real>(balance: &mut Balance<R>, step: R) {
    let zero = R::of(0.0);
    (balance.back, balance.keep, balance.push, balance.forward) = (R::of(-0.5) * step, zero, zero, zero);
}

fn fire<R: Real>(balance: &mut Balance<R>, step: &mut R, [power, pull, motion, ..]: &Measure<R>) {
    let (power, pull, motion) = (*power, *pull, *motion);
    if power < R::of(0.0) {
        stop(balance, *step);
        (balance.mixing, balance.downhill) = (R::of(START_MIXING), 0);
        *step = (R::of(SHORTER) * *step).max(R::of(SHORTEST_STEP) * balance.longest);
        return;
    }
    balance.downhill += 1;
    if balance.downhill > PATIENCE {
        *step = (R::of(LONGER) * *step).min(balance.longest);
        balance.mixing = balance.mixing * R::of(LESS_MIXING);
    }
    // |v + step a|, the speed after the kick.
    let speed = (motion + *step * (R::of(2.0) * power + *step * pull)).sqrt();
    balance.back = R::of(0.0);
    balance.keep = R::of(1.0) - balance.mixing;
    balance.push = balance.keep * *step + balance.mixing * speed / pull.sqrt();
    balance.forward = *step;
}

fn damp<R: Real>(balance: &mut Balance<R>, step: R, [power, pull, ..]: &Measure<R>) {
    // Twice the gain of kinetic energy by a kick, over the step.
    if R::of(2.0) * *power + step * *pull < R::of(0.0) {
        stop(balance, step);
        return;
    }
    (balance.back, balance.keep, balance.push, balance.forward) = (R::of(0.0), R::of(1.0), step, step);
}
