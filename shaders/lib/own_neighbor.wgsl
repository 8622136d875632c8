// A neighbour of the same body, or of one that it is tied to, in the kernel's range, now or in the reference configuration. The pass declares
// `reference_position` and `displacement`. Twin: own_neighbors in src/pass/find_surface.rs
#import body
#import separation

@group(0) @binding(_) var<storage, read> neighbors: array<u32>;
@group(0) @binding(_) var<storage, read> neighbor_count: array<u32>;

// Places are those of the reference configuration.
override stage_reference: bool;

struct OwnNeighbor {
    // x_a - x_b
    x: Vec,
    within: bool,
}

fn own_neighbor(a: u32, b: u32) -> OwnNeighbor {
    let moved_a = select(displacement[a], Vec(), stage_reference);
    let moved_b = select(displacement[b], Vec(), stage_reference);
    let x = separation(reference_position[a], moved_a, b, moved_b);
    let reach = 2.0 * smoothing_length(a);
#if tied
    // A list of the reference configuration has no others.
    let own = true;
#else
    let own = body_index(a) == body_index(b);
#endif
    return OwnNeighbor(x, own && inner(x, x) < reach * reach);
}
