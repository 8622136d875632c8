// Inverse of K_a = sum V_b (x_b - x_a) (x) grad_a W_ab (Bonet & Lok 1999). Twin: src/pass/correct_gradient.rs
#import pair
#import coupling
#import inverse
#import volume

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
@group(0) @binding(_) var<storage, read_write> correction: array<Mat>;

fn of_particle(a: u32, row: u32) {
    let center = center_of(a);
    let count = neighbor_count[a];
    var moment = Mat();
    for (var k = 0u; k < count; k++) {
        let pair = pair_of(center, neighbors[k * params.chunk + row]);
        let weight = volume(pair.b) * pair_coupling(center.body, pair.b) * pair.gradient;
        moment -= outer(pair.x, pair.x * weight);
    }
    correction[a] = safe_inverse(moment);
}
