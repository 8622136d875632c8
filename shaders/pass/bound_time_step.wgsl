// Ends a step: advances the clock, finds the next step, whether the neighbour list still holds, and faults.
// Twin: src/pass/bound_time_step.rs
//
// step = cfl min(h/(c (1 + 0.6 alpha) + 0.6 beta h |tr L|), sqrt(h/|a|)), Monaghan 1992.
#import invocation
#import body
#import largest

@group(0) @binding(_) var<storage, read_write> clock: Clock;
@group(0) @binding(_) var<storage, read_write> block_bound: array<vec4<real>>;
#if listed_again
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> listed_displacement: array<Vec>;
#endif
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read> acceleration: array<Vec>;
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
    var rate = max(signal / h, sqrt(sqrt(pull) / h));
#if facets
    rate = sqrt(rate * rate + params.contact_rate);
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

fn next_clock(before: Clock, bound: vec4<real>) -> Clock {
    var next = before;
    // The first call of a segment comes before any step: it advances no clock and only finds the first step.
    if next.step > 0.0 {
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
    var step = params.fixed_step;
    if step <= 0.0 {
        step = params.cfl / bound.x;
    }
    // A remainder below this is the rounding error of the sum of steps, not time that is left.
    if next.fault != 0u || next.steps_left == 0u || left <= 1e-5 * step {
        next.running = 0u;
        return next;
    }
    // The last two steps share the time that is left, so that the last one is not much shorter than the others.
    if left <= step * 1.00001 {
        step = left;
    } else if left < 2.0 * step && params.fixed_step == 0.0 {
        step = left * 0.5;
    }
    next.step = step;
#if listed_again
    let ahead = sqrt(bound.y) + sqrt(bound.z) * step;
    next.rebuild = u32(ahead > params.slack);
#else
    next.rebuild = 0u;
#endif
    return next;
}
