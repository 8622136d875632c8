// Velocity gradient L_a. Twin: src/pass/strain_rate.rs
//
// Plain: L_a = (1/rho_a) sum m_b (v_b - v_a) (x) grad_a W_ab, Fuller (2.14) with the density outside the sum.
//
// Corrected: weights V_b, and the sum is multiplied by the inverse of sum V_b (x_b - x_a) (x) grad_a W_ab,
// which makes it exact for linear velocity fields (Bonet & Lok 1999).
#import pair
#import pair_velocity
#import coupling
#import inverse if correct_rate
#import volume if correct_rate
#import mass if !correct_rate
#import density if !correct_rate

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity_gradient: array<Mat>;

fn of_particle(a: u32, row: u32) {
#if correct_rate
    velocity_gradient[a] = corrected_gradient(a, row);
#else
    velocity_gradient[a] = plain_gradient(a, row);
#endif
}

#if correct_rate
fn corrected_gradient(a: u32, row: u32) -> Mat {
    let center = center_of(a);
    let velocity_a = velocity[a];
    let count = neighbor_count[a];
    var sum = Mat();
    var moment = Mat();
    for (var k = 0u; k < count; k++) {
        let pair = pair_of(center, neighbors[k * params.chunk + row]);
        let weighted = pair.x * (volume(pair.b) * pair_coupling(center.body, pair.b) * pair.gradient);
        sum += outer(velocity_difference(velocity_a, pair), weighted);
        moment -= outer(pair.x, weighted);
    }
    return mat_mat(sum, safe_inverse(moment));
}
#else
fn plain_gradient(a: u32, row: u32) -> Mat {
    let center = center_of(a);
    let velocity_a = velocity[a];
    let count = neighbor_count[a];
    var sum = Mat();
    for (var k = 0u; k < count; k++) {
        let pair = pair_of(center, neighbors[k * params.chunk + row]);
        let weighted = pair.x * (mass(pair.b) * pair_coupling(center.body, pair.b) * pair.gradient);
        sum += outer(velocity_difference(velocity_a, pair), weighted);
    }
    return sum * (1.0 / density(a));
}
#endif
