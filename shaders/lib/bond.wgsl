// A neighbour in the reference configuration. The pass declares `reference_position`. Twin: Bond in src/bond.rs
//
// A loop reads entry k of its particle from neighbors[k * params.chunk + row].
#import body
#import kernel
#import separation

@group(0) @binding(_) var<storage, read> neighbors: array<u32>;
@group(0) @binding(_) var<storage, read> neighbor_count: array<u32>;

struct Bond {
    b: u32,
    // Planes that the neighbour is mirrored in, one bit each.
    image: u32,
    // X_a - X_b
    x: Vec,
    // (dW/dR)/R: times x it is the gradient of W at a.
    gradient: real,
}

fn bond_of(reference_a: Vec, h: real, entry: u32) -> Bond {
    let x = separation(reference_a, Vec(), entry, Vec());
    return Bond(entry & NEIGHBOR_MASK, entry >> NEIGHBOR_BITS, x, gradient(sqrt(inner(x, x)), h));
}
