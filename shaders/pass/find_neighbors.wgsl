// Lists the particles within reach of each particle, mirror images included, in cell order.
// Twin: src/pass/find_neighbors.rs
#import visit_cells
#import separation
#import coupling if coupling

@group(0) @binding(_) var<storage, read_write> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> cell_start: array<u32>;
@group(0) @binding(_) var<storage, read> cell_particles: array<u32>;
#if list_follows
@group(0) @binding(_) var<storage, read_write> listed_displacement: array<Vec>;
#endif
@group(0) @binding(_) var<storage, read_write> neighbors: array<u32>;
@group(0) @binding(_) var<storage, read_write> neighbor_count: array<u32>;

// Particles are listed where they are in the reference configuration.
override stage_reference: bool;

// The particle whose neighbours are sought, and the image that they are sought in.
struct Search {
    a: u32,
    row: u32,
    image: u32,
    reference: Vec,
    displacement: Vec,
#if coupling
    body: u32,
#endif
}

fn of_particle(a: u32, row: u32) {
    let search = search_of(a, row);
#if list_follows
    if !stage_reference {
        listed_displacement[a] = search.displacement;
    }
#endif
    let found = list_one(search);
    if found == TOO_MANY {
        neighbor_count[a] = 0u;
        clock.fault = LIST_FULL;
    } else {
        neighbor_count[a] = found;
    }
}

fn shift_of(b: u32) -> Vec {
    return select(displacement[b], Vec(), stage_reference);
}

fn search_of(a: u32, row: u32) -> Search {
    var search: Search;
    search.a = a;
    search.row = row;
    search.reference = reference_position[a];
    search.displacement = shift_of(a);
#if coupling
    search.body = body_index(a);
#endif
    return search;
}

// Fills one particle's list; TOO_MANY if it is too short.
fn list_one(own: Search) -> u32 {
    let x = own.reference + own.displacement;
#if symmetry
    var search = own;
    var found = 0u;
    // The image of every particle within reach of a is near a's own image only if a is near the plane.
    let limit = 2.0 * params.reach * sqrt(real(params.plane_count));
    for (var image = 0u; image < (1u << params.plane_count) && found != TOO_MANY; image++) {
        let center = mirror_point(image, x);
        let apart = x - center;
        if image == 0u || inner(apart, apart) <= limit * limit {
            search.image = image;
            found = visit_cells(search, center, found);
        }
    }
    return found;
#else
    return visit_cells(own, x, 0u);
#endif
}

// Lists those within reach of a stretch of particles.
fn visit(search: Search, first: u32, end: u32, found_before: u32) -> u32 {
    var found = found_before;
    for (var k = first; k < end; k++) {
        let b = cell_particles[k];
        if search.image == 0u && b == search.a {
            continue;
        }
        let entry = b | (search.image << NEIGHBOR_BITS);
        let apart = separation(search.reference, search.displacement, entry, shift_of(b));
        if inner(apart, apart) >= params.reach * params.reach {
            continue;
        }
#if coupling
        if pair_coupling(search.body, b) == 0.0 {
            continue;
        }
#endif
        if found == params.list_capacity {
            return TOO_MANY;
        }
        neighbors[found * params.chunk + search.row] = entry;
        found += 1u;
    }
    return found;
}
