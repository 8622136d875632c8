// rho_a = sum m_b W_ab, the particle itself included, Fuller (2.22). Twin: src/pass/sum_density.rs
#import pair
#import mass
#import coupling

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read_write> volumetric_strain: array<real>;

fn of_particle(a: u32, row: u32) {
    let center = center_of(a);
    let count = neighbor_count[a];
    var density = mass(a) * weight(0.0, center.h);
    for (var k = 0u; k < count; k++) {
        let pair = pair_of(center, neighbors[k * params.chunk + row]);
        density += mass(pair.b) * pair_coupling(center.body, pair.b) * weight(pair.distance, pair.h);
    }
    volumetric_strain[a] = body_of(a).density / density - 1.0;
}
