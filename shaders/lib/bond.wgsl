// A neighbour in the reference configuration. The pass declares `reference_position`. Twin: Bond in src/bond.rs
//
// A loop reads entry k of its particle from neighbors[k * params.chunk + row].
#import body
#import kernel
#import separation
#import coupling if tied

@group(0) @binding(_) var<storage, read> neighbors: array<u32>;
@group(0) @binding(_) var<storage, read> neighbor_count: array<u32>;

struct Bond {
    b: u32,
    // Planes that the neighbour is mirrored in, one bit each.
    image: u32,
    // X_a - X_b
    x: Vec,
    // (dW/dR)/R: times x it is the gradient of W at a. Where bodies are tied, times a's weight of the bond.
    gradient: real,
}

// The first particle is given by its body, place and h, which a loop over neighbours looks up once.
fn bond_of(body_a: u32, reference_a: Vec, h: real, entry: u32) -> Bond {
    let x = separation(reference_a, Vec(), entry, Vec());
    let b = entry & NEIGHBOR_MASK;
    var slope = gradient(sqrt(inner(x, x)), h);
#if tied
    slope *= pair_coupling(body_a, b);
#endif
    return Bond(b, entry >> NEIGHBOR_BITS, x, slope);
}

#if tied
// Weight of a bond at its far end b over that at a, whose slope has the latter. Twin: far_weight in src/bond.rs
fn far_weight(body_a: u32, a: u32, b: u32) -> real {
    return pair_coupling(body_index(b), a) / pair_coupling(body_a, b);
}
#endif
