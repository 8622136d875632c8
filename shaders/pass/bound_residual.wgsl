// Ends a step of the descent to equilibrium: how far the particles are from it, and how the next step goes.
// Twin: src/pass/bound_residual.rs
//
// Residual: the largest out-of-balance force on what is free, over max E (V/h) max(|e|, 1e-6), e Green's strain.
#import invocation
#import descent
#import mass
#import unbalanced

@group(0) @binding(_) var<storage, read_write> clock: Clock;
@group(0) @binding(_) var<storage, read_write> balance: Balance;
@group(0) @binding(_) var<storage, read_write> block_residual: array<Measure>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read> acceleration: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement_gradient: array<Mat>;

const REDUCTION_BLOCK: u32 = 256u;

var<workgroup> shared_measure: array<Measure, 256>;

fn joined(a: Measure, b: Measure) -> Measure {
    return Measure(a.sum + b.sum, max(a.most, b.most));
}

// Over the workgroup; good in its first invocation. Two rounds of sixteen, as in bound_time_step.
fn whole(local: u32, own: Measure) -> Measure {
    shared_measure[local] = own;
    workgroupBarrier();
    if local < 16u {
        for (var k = local + 16u; k < REDUCTION_BLOCK; k += 16u) {
            shared_measure[local] = joined(shared_measure[local], shared_measure[k]);
        }
    }
    workgroupBarrier();
    var all = shared_measure[0];
    for (var k = 1u; k < 16u; k += 1u) {
        all = joined(all, shared_measure[k]);
    }
    return all;
}

@compute @workgroup_size(256)
fn blocks(invocation: Invocation) {
    let block = block_of(invocation);
    let a = block * REDUCTION_BLOCK + invocation.local;
    var own = Measure();
    if a < params.count && clock.running != 0u {
        own = measure_of(a);
    }
    let all = whole(invocation.local, own);
    if invocation.local == 0u && a < params.count && clock.running != 0u {
        block_residual[block] = all;
    }
}

fn measure_of(a: u32) -> Measure {
    let own = body_of(a);
    let weight = mass(a);
    let pull = unbalanced(a);
    let square = inner(pull, pull);
    let motion = inner(velocity[a], velocity[a]);
    let gradient = displacement_gradient[a];
    var fault: real = 0.0;
    if determinant_mat(mat_identity() + gradient) <= 0.0 {
        fault = real(INVERTED);
    }
    // The test looks at the bits, since a compiler may assume that no number is infinite or NaN and drop a comparison.
    if (bitcast<u32>(square + motion) & 0x7f800000u) == 0x7f800000u {
        fault = real(NOT_FINITE);
    }
    let sum = vec4<real>(inner(pull, velocity[a]), square, motion, 0.0) * weight;
    var rate = own.sound_speed / smoothing_length(a);
#if facets
    rate = sqrt(rate * rate + params.contact_rate);
#endif
    return Measure(sum, vec4<real>(weight * sqrt(square), force_scale(a, gradient), rate, fault));
}

// E (V/h) max(|e|, 1e-6), e = (H + H^T + H^T H)/2.
fn force_scale(a: u32, h: Mat) -> real {
    let own = body_of(a);
    let product = mat_of_sym(sym_part(mat_mat(transpose_mat(h), h)));
    let strain = mat_of_sym(sym_part(h)) + product * 0.5;
    let size = sqrt(trace(mat_mat(strain, strain)));
    return own.youngs_modulus * reference_volume[a] / smoothing_length(a) * max(size, 1e-6);
}

@compute @workgroup_size(256)
fn advance(invocation: Invocation) {
    let count = (params.count + REDUCTION_BLOCK - 1u) / REDUCTION_BLOCK;
    var own = Measure();
    for (var block = invocation.local; block < count; block += REDUCTION_BLOCK) {
        own = joined(own, block_residual[block]);
    }
    let all = whole(invocation.local, own);
    if invocation.local == 0u && clock.running != 0u {
        go_on(all);
    }
}
