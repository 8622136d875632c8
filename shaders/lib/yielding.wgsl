// How far a strength gives way in a step. Twin: src/material/yielding.rs
#import flow
#import strengths
#import heats

// Rounds of Newton's method in `increment` at most; most laws take three.
const RETURN_ROUNDS: u32 = 24u;
// Error of a flow stress, relative to it, that counts as rounding: four distances from one number to the next.
const RETURN_ROUNDING: real = 4.8e-7;
// Part of the highest possible growth that is tried next where Newton's method has left its bounds and no lower bound is
// known yet.
const RETURN_PART: real = 1e-3;

// The state at the end of a step in which nothing has flowed yet.
struct Trial {
    // Mises stress if nothing flowed.
    stress: real,
    strain: real,
    temperature: real,
    // By how much the trial stress falls for each unit of growth of the plastic strain, 3 mu.
    stiffness: real,
    // Time that the step takes.
    step: real,
    // Volume over reference volume, by which work per volume becomes work per reference volume.
    volume: real,
}

fn trial_rate(trial: Trial, growth: real) -> real {
    if trial.step > 0.0 {
        return growth / trial.step;
    }
    return 0.0;
}

// The point at which the strength is asked after a growth over which the flow stress goes from `begin` to `end`: the plastic
// work is the mean of the two times the growth.
fn trial_point(body: Body, trial: Trial, growth: real, begin: real, end: real) -> Point {
    let temperature = trial.temperature + rise(body, 0.5 * (begin + end) * growth * trial.volume);
    return Point(trial.strain + growth, trial_rate(trial, growth), temperature);
}

// Derivative of the flow stress by the growth.
fn trial_slope(trial: Trial, at: Flow) -> real {
    if trial.step > 0.0 {
        return at.by_strain + at.by_rate / trial.step;
    }
    return at.by_strain;
}

// Flow stress before the step, at rest.
fn trial_rest(body: Body, trial: Trial) -> Flow {
    return flow(body, Point(trial.strain, 0.0, trial.temperature));
}

// Flow stress where the step begins, at its own rate.
fn trial_begin(body: Body, trial: Trial, growth: real) -> real {
    return flow(body, Point(trial.strain, trial_rate(trial, growth), trial.temperature)).stress;
}

// d of trial - stiffness d = sY(k + d, d/step, T(d)), by Newton's method in ln d between bounds that close in.
fn increment(body: Body, trial: Trial, rest: Flow) -> real {
    let stiffness = trial.stiffness;
    var low: real = 0.0;
    var high = (trial.stress - rest.stress) / stiffness;
    var d = (trial.stress - rest.stress) / (stiffness + rest.by_strain);
    for (var round = 0u; round < RETURN_ROUNDS; round++) {
        let begin = trial_begin(body, trial, d);
        let at = flow(body, trial_point(body, trial, d, begin, trial.stress - stiffness * d));
        let excess = trial.stress - stiffness * d - at.stress;
        if abs(excess) <= RETURN_ROUNDING * trial.stress {
            break;
        }
        if excess > 0.0 {
            low = d;
        } else {
            high = d;
        }
        d *= exp(min(excess / ((stiffness + trial_slope(trial, at)) * d), 80.0));
        if d <= low || d >= high {
            d = select(high * RETURN_PART, sqrt(low * high), low > 0.0);
        }
    }
    return d;
}
