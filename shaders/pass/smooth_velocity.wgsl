// Velocity averaged over neighbours, Fuller (3.2): v_a + weight sum (m_b/rho_ab)(v_b - v_a) W_ab.
// Twin: src/pass/smooth_velocity.rs
#import pair
#import pair_velocity
#import coupling
#import mass
#import density

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> smoothed_velocity: array<Vec>;

fn of_particle(a: u32, row: u32) {
    let center = center_of(a);
    let velocity_a = velocity[a];
    let density_a = density(a);
    let count = neighbor_count[a];
    var sum = Vec();
    for (var k = 0u; k < count; k++) {
        let pair = pair_of(center, neighbors[k * params.chunk + row]);
        let mean_density = 0.5 * (density_a + density(pair.b));
        let mass_b = mass(pair.b) * pair_coupling(center.body, pair.b);
        sum += velocity_difference(velocity_a, pair) * (mass_b / mean_density * weight(pair.distance, pair.h));
    }
    smoothed_velocity[a] = velocity_a + sum * params.smoothing_weight;
}
