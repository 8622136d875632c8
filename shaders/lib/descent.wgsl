// What the next step of the descent to equilibrium does, from the sums over all particles: FIRE (Bitzek et al. 2006)
// or kinetic damping (Cundall 1982). The pass declares `clock` and `balance`.
// Twin: src/pass/bound_residual/descent.rs
#import params

const START_MIXING: real = 0.1;
const LESS_MIXING: real = 0.99;
const LONGER: real = 1.1;
const SHORTER: real = 0.5;
// Steps downhill after which the step grows.
const PATIENCE: u32 = 5u;
// Length of the first step, and of the shortest one, over the longest stable step.
const FIRST_STEP: real = 0.25;
const SHORTEST_STEP: real = 0.02;

struct Measure {
    // m a.v, m a^2, m v^2
    sum: vec4<real>,
    // Largest force, force scale, rate c/h, fault.
    most: vec4<real>,
}

fn go_on(all: Measure) {
    var next = clock;
    var plan = balance;
    // The first call of a segment comes before any step: it sets the first step and counts none.
    if next.step > 0.0 {
        next.steps_left -= 1u;
        next.steps_done += 1u;
    } else {
        plan = Balance();
        plan.mixing = START_MIXING;
        plan.longest = params.cfl / all.most.z;
#if fire
        next.step = FIRST_STEP * plan.longest;
#else
        next.step = plan.longest;
#endif
    }
    next.lists_built += next.rebuild;
#if listed_again
    next.rebuild = 1u;
#else
    next.rebuild = 0u;
#endif
    next.residual = all.most.x / all.most.y;
    next = ended(next, u32(all.most.w));
    if next.running != 0u {
#if fire
        if all.sum.x >= 0.0 && plan.downhill >= PATIENCE {
            next.step = min(LONGER * next.step, plan.longest);
        }
        plan = fire(plan, next.step, all.sum);
        if all.sum.x < 0.0 {
            next.step = max(SHORTER * next.step, SHORTEST_STEP * plan.longest);
        }
#else
        plan = damp(plan, next.step, all.sum);
#endif
    }
    clock = next;
    balance = plan;
}

// Whether the load step is over, for good or ill.
fn ended(before: Clock, fault: u32) -> Clock {
    var next = before;
    if next.fault == 0u {
        next.fault = fault;
    }
    if next.fault != 0u || next.duration == 0.0 {
        next.running = 0u;
    } else if next.residual <= params.residual {
        next.elapsed = next.duration;
        next.running = 0u;
    } else if next.steps_left == 0u {
        next.fault = NO_EQUILIBRIUM;
        next.running = 0u;
    }
    return next;
}

fn stopped(before: Balance, step: real) -> Balance {
    var next = before;
    next.back = -0.5 * step;
    next.keep = 0.0;
    next.push = 0.0;
    next.forward = 0.0;
    return next;
}

#if fire
fn fire(before: Balance, step: real, sum: vec4<real>) -> Balance {
    var next = before;
    if sum.x < 0.0 {
        next.mixing = START_MIXING;
        next.downhill = 0u;
        return stopped(next, step);
    }
    next.downhill += 1u;
    if next.downhill > PATIENCE {
        next.mixing *= LESS_MIXING;
    }
    // |v + step a|, the speed after the kick.
    let speed = sqrt(sum.z + step * (2.0 * sum.x + step * sum.y));
    next.back = 0.0;
    next.keep = 1.0 - next.mixing;
    next.push = next.keep * step + next.mixing * speed / sqrt(sum.y);
    next.forward = step;
    return next;
}
#else
fn damp(before: Balance, step: real, sum: vec4<real>) -> Balance {
    // Twice the gain of kinetic energy by a kick, over the step.
    if 2.0 * sum.x + step * sum.y < 0.0 {
        return stopped(before, step);
    }
    var next = before;
    next.back = 0.0;
    next.keep = 1.0;
    next.push = step;
    next.forward = step;
    return next;
}
#endif
