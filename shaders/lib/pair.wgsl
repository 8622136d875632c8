// What the loops over neighbours share. The pass declares `reference_position` and `displacement`.
// Twin: src/pair.rs
//
// A loop reads entry k of its particle from neighbors[k * params.chunk + row]: entries of the same k lie side
// by side, so that the invocations of a group read one stretch of memory.
#import body
#import kernel
#import separation

@group(0) @binding(_) var<storage, read> neighbors: array<u32>;
@group(0) @binding(_) var<storage, read> neighbor_count: array<u32>;

// What particle a brings into all of its pairs.
struct Center {
    body: u32,
    h: real,
    reference: Vec,
    displacement: Vec,
}

// A neighbour as particle a sees it.
struct Pair {
    b: u32,
    // Planes that the neighbour is mirrored in, one bit each.
    image: u32,
    // x_a - x_b
    x: Vec,
    distance: real,
    // Mean smoothing length of the two.
    h: real,
    // (dW/dr)/r: times x it is the gradient of W at a.
    gradient: real,
}

fn center_of(a: u32) -> Center {
    return Center(body_index(a), smoothing_length(a), reference_position[a], displacement[a]);
}

fn pair_of(center: Center, entry: u32) -> Pair {
    let b = entry & NEIGHBOR_MASK;
    let x = separation(center.reference, center.displacement, entry, displacement[b]);
#if many_bodies
    let h = 0.5 * (center.h + smoothing_length(b));
#else
    let h = center.h;
#endif
    let distance = sqrt(inner(x, x));
    return Pair(b, entry >> NEIGHBOR_BITS, x, distance, h, gradient(distance, h));
}
