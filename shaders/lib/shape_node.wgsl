// The particles whose shape functions do not vanish where a particle is, itself among them. The pass declares
// `reference_position`, `displacement`, `reference_volume`, and in the current configuration `volumetric_strain`.
// Twin: nodes in src/shape_function.rs
#import body
#import kernel
#import separation
#import coupling
#import shape

@group(0) @binding(_) var<storage, read> neighbors: array<u32>;
@group(0) @binding(_) var<storage, read> neighbor_count: array<u32>;

// Sums run over the reference configuration.
override stage_reference: bool;

// What particle a brings into all of its sums.
struct Center {
    a: u32,
    row: u32,
    body: u32,
    // Neighbours, without a itself.
    count: u32,
    h: real,
    reference: Vec,
    displacement: Vec,
}

struct Node {
    b: u32,
    // Planes that it is mirrored in, one bit each.
    image: u32,
    // x_a - x_b
    x: Vec,
    // Weight of sums between the two bodies.
    coupled: real,
    // W and W'/r
    weight: real,
    slope: real,
}

fn shift_of(b: u32) -> Vec {
    return select(displacement[b], Vec(), stage_reference);
}

fn center_of(a: u32, row: u32) -> Center {
    let h = smoothing_length(a);
    return Center(a, row, body_index(a), neighbor_count[a], h, reference_position[a], shift_of(a));
}

// For k from 0 to center.count; the last is a itself.
fn node_at(center: Center, k: u32) -> Node {
    var entry = center.a;
    if k < center.count {
        entry = neighbors[k * params.chunk + center.row];
    }
    let b = entry & NEIGHBOR_MASK;
    let x = separation(center.reference, center.displacement, entry, shift_of(b));
#if many_bodies
    let h = 0.5 * (center.h + smoothing_length(b));
#else
    let h = center.h;
#endif
    let distance = sqrt(inner(x, x));
    let coupled = pair_coupling(center.body, b);
    return Node(b, entry >> NEIGHBOR_BITS, x, coupled, weight(distance, h), gradient(distance, h));
}

// V_b times the weight between the bodies.
fn volume_of(node: Node) -> real {
    let volume = reference_volume[node.b] * node.coupled;
#if current
    return volume * select(1.0 + volumetric_strain[node.b], 1.0, stage_reference);
#else
    return volume;
#endif
}
