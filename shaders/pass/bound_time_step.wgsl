// Ends a step: advances the clock, finds the next step, whether the neighbour list still holds, and faults.
// Twin: src/pass/bound_time_step.rs
//
// step = cfl min(h/(c (1 + 0.6 alpha) + 0.6 beta h |tr L|), sqrt(h/|a|)), Monaghan 1992, with c as the present deformation has it,
// no longer than the integrator bears; a segment is parted into equal steps.
#import invocation
#import body
#import largest
#import stiffening if finite_strain

@group(0) @binding(_) var<storage, read_write> clock: Clock;
@group(0) @binding(_) var<storage, read_write> block_bound: array<vec4<real>>;
#if listed_again
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> listed_displacement: array<Vec>;
#endif
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read> acceleration: array<Vec>;
#if potentials
@group(0) @binding(_) var<storage, read> contact_rate: array<real>;
#endif
#if finite_strain
@group(0) @binding(_) var<storage, read> displacement_gradient: array<Mat>;
#else
@group(0) @binding(_) var<storage, read> velocity_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
#endif

@compute @workgroup_size(256)
fn blocks(invocation: Invocation) {
    let block = block_of(invocation);
    let a = block * REDUCTION_BLOCK + invocation.local;
    var own = vec4<real>();
    if a < params.count && clock.running != 0u {
        own = bound_of(a);
    }
    let bound = largest(invocation.local, own);
    if invocation.local == 0u && a < params.count && clock.running != 0u {
        block_bound[block] = bound;
    }
}

// Rate, squared displacement since the list was built, squared speed, fault of one particle.
fn bound_of(a: u32) -> vec4<real> {
    let own = body_of(a);
    let h = smoothing_length(a);
#if finite_strain
    let compression: real = 0.0;
#else
    let compression = abs(trace(velocity_gradient[a]));
#endif
    let signal = own.sound_speed * (1.0 + 0.6 * params.alpha) + 0.6 * params.beta * h * compression;
    let pull = inner(acceleration[a], acceleration[a]);
    var waves = signal / h;
#if finite_strain
    if params.stable > 0.0 {
        waves = max(waves, params.cfl / params.stable * own.frequency * (1.0 + 0.6 * params.alpha));
        waves *= sqrt(clamp(stiffening(own, displacement_gradient[a]), 1.0, STIFFEST));
    }
#endif
    var rate = max(waves, sqrt(sqrt(pull) / h));
#if facets
    rate = sqrt(rate * rate + params.contact_rate);
#endif
#if potentials
    rate = sqrt(rate * rate + contact_rate[a]);
#endif
#if listed_again
    let shift = displacement[a] - listed_displacement[a];
    let moved = inner(shift, shift);
#else
    let moved: real = 0.0;
#endif
    let speed = inner(velocity[a], velocity[a]);
    // The test looks at the bits, since a compiler may assume that no number is infinite or NaN and drop a comparison.
    let exponent = bitcast<u32>(pull + moved + speed + compression) & 0x7f800000u;
    if exponent == 0x7f800000u {
        return vec4<real>(0.0, 0.0, 0.0, real(NOT_FINITE));
    }
#if finite_strain
    let inverted = determinant_mat(mat_identity() + displacement_gradient[a]) <= 0.0;
#else
    let inverted = 1.0 + volumetric_strain[a] <= 0.0;
#endif
    return vec4<real>(rate, moved, speed, select(0.0, real(INVERTED), inverted));
}

@compute @workgroup_size(256)
fn advance(invocation: Invocation) {
    let count = (params.count + REDUCTION_BLOCK - 1u) / REDUCTION_BLOCK;
    var own = vec4<real>();
    for (var block = invocation.local; block < count; block += REDUCTION_BLOCK) {
        own = max(own, block_bound[block]);
    }
    let bound = largest(invocation.local, own);
    if invocation.local == 0u && clock.running != 0u {
        clock = next_clock(clock, bound);
    }
}

fn hidden_number(x: real) -> real {
    return bitcast<real>(bitcast<u32>(x) ^ params.zero);
}

#if finite_strain
const HOLDS = true;
#else
const HOLDS = false;
#endif
const STIFFEST: real = 1e4;
const SLACK: real = 1.05;
const RUNG: real = 0.8408964152537146;

fn next_clock(before: Clock, bound: vec4<real>) -> Clock {
    var next = before;
    // The first call of a segment comes before any step: it advances no clock and only finds the first step.
    if before.step > 0.0 {
        // The sum keeps its rounding error as in compensated_add.
        let corrected = next.step - next.elapsed_carry;
        let total = hidden_number(next.elapsed + corrected);
        next.elapsed_carry = hidden_number(total - next.elapsed) - corrected;
        next.elapsed = total;
        next.steps_left -= 1u;
        next.steps_done += 1u;
    }
#if listed_again
    next.lists_built += next.rebuild;
#else
    next.lists_built = 1u;
#endif
    if next.fault == 0u {
        next.fault = u32(bound.w);
    }
    let left = next.duration - next.elapsed;
    // A remainder below this is the rounding error of the sum of steps, not time that is left.
    let arrived = left <= 1e-4 * before.step;
    if before.step > 0.0 {
        next.arrived = u32(arrived);
    }
    if next.fault != 0u || next.steps_left == 0u || arrived {
        next.running = 0u;
        return next;
    }
    let longest = params.cfl / bound.x;
    var held = next.held;
    if before.step <= 0.0 && next.arrived != 0u {
        held = 0.0;
    }
    if params.fixed_step > 0.0 {
        next.step = select(params.fixed_step, left, left <= params.fixed_step * 1.00001);
    } else if HOLDS && held > 0.0 && held <= SLACK * longest {
        next.step = parted(left, ceil(left / held - 0.01));
    } else {
        next.step = parted(left, parts(left, params.interval, rung(longest)));
    }
    if abs(next.step - next.held) > 0.01 * next.held && next.held > 0.0 {
        next.changes += 1u;
    }
    next.held = next.step;
#if listed_again
    let ahead = sqrt(bound.y) + sqrt(bound.z) * next.step;
    next.rebuild = u32(ahead > params.slack);
#else
    next.rebuild = 0u;
#endif
    return next;
}

// A part of the time that is left; all of it if it is in no more than one.
fn parted(left: real, parts: real) -> real {
    return select(left, left / parts, parts > 1.5);
}

// The longest of the lengths that a held step has.
fn rung(longest: real) -> real {
    var step = params.rest_step;
    if !HOLDS || step <= 0.0 {
        return longest;
    }
    for (var k = 0u; k < 200u; k++) {
        if step <= SLACK * longest {
            return step;
        }
        step *= RUNG;
    }
    return longest;
}

// In how many steps to go what is left: as many from output to output as everywhere else.
fn parts(left: real, interval: real, longest: real) -> real {
    var intervals: real = 0.0;
    if interval > 0.5 * longest {
        intervals = round(left / interval);
    }
    if intervals > 0.5 && abs(left - intervals * interval) < 1e-4 * interval {
        return intervals * max(ceil(interval / longest - 1e-5), 1.0);
    }
    return ceil(left / longest - 1e-5);
}
