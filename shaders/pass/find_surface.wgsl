// Finds which particles lie on the surface of their body: those with no more than a share of the most neighbours in the
// kernel's range, and which of them are corners. Twin: src/pass/find_surface.rs
#import own_neighbor
#import zones

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> surface: array<u32>;

fn of_particle(a: u32, row: u32) {
    let listed = neighbor_count[a];
    var count = 0u;
    for (var k = 0u; k < listed; k++) {
        count += u32(own_neighbor(a, neighbors[k * params.chunk + row]).within);
    }
    surface[a] = select(select(0u, SURFACE, count <= params.surface_count), CORNER, count <= params.corner_count);
}
