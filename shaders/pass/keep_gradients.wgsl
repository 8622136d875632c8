// Keeps the neighbours of the reference configuration, and V_b times the gradient at a of b's shape function there,
// for a list that will follow the particles. Twin: src/pass/keep_gradients.rs
#import shape_node
#import shape_columns

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
@group(0) @binding(_) var<storage, read_write> kept_count: array<u32>;
@group(0) @binding(_) var<storage, read_write> kept_neighbors: array<u32>;
@group(0) @binding(_) var<storage, read_write> kept_gradients: array<Vec>;

fn of_particle(a: u32, row: u32) {
    let center = center_of(a, row);
    let own = shape_of(a);
    kept_count[a] = center.count;
    // The last node is particle a itself. It is left out: its displacement differs from a's own by nothing.
    for (var k = 0u; k < center.count; k++) {
        let node = node_at(center, k);
        kept_neighbors[k * params.count + a] = neighbors[k * params.chunk + row];
        kept_gradients[k * params.count + a] = shape_gradient(own, node.x, node.weight, node.slope) * volume_of(node);
    }
}
