// Normals of surface particles, Fuller (4.1): sum W_ab (x_a - x_b)/r_ab made a unit vector, over all neighbours of the
// same body or over those inside alone; zero where nothing is left to sum. Twin: src/pass/find_normals.rs
#import own_neighbor
#import kernel

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> surface: array<u32>;
@group(0) @binding(_) var<storage, read_write> surface_normal: array<Vec>;

fn of_particle(a: u32, row: u32) {
    var normal = Vec();
    if surface[a] != 0u {
        normal = normal_of(a, row);
    }
    surface_normal[a] = normal;
}

fn normal_of(a: u32, row: u32) -> Vec {
    let h = smoothing_length(a);
    let listed = neighbor_count[a];
    var sum = Vec();
    var total: real = 0.0;
    for (var k = 0u; k < listed; k++) {
        let b = neighbors[k * params.chunk + row];
        let neighbor = own_neighbor(a, b);
#if zones_all
        let counts = neighbor.within;
#else
        let counts = neighbor.within && surface[b] == 0u;
#endif
        if counts {
            let distance = sqrt(inner(neighbor.x, neighbor.x));
            let part = weight(distance, h);
            sum += neighbor.x * (part / max(distance, 1e-6 * h));
            total += part;
        }
    }
    let length = sqrt(inner(sum, sum));
    // Where neighbours on all sides cancel there is no normal, only rounding.
    if length > 1e-4 * total {
        return sum * (1.0 / length);
    }
    return Vec();
}
