// H_a = sum V_b (u_b - u_a) (x) grad psi_b(X_a) in the reference configuration, Shutov & Klyuchantsev 2019 (8).
// Twin: src/pass/deform_by_shape.rs
#import params if kept_gradients
#import mirror if kept_gradients
#import shape_node if !kept_gradients
#import shape_columns if !kept_gradients

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
#if kept_gradients
@group(0) @binding(_) var<storage, read> kept_count: array<u32>;
@group(0) @binding(_) var<storage, read> kept_neighbors: array<u32>;
@group(0) @binding(_) var<storage, read> kept_gradients: array<Vec>;
#else
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#endif
@group(0) @binding(_) var<storage, read_write> displacement_gradient: array<Mat>;

fn of_particle(a: u32, row: u32) {
    displacement_gradient[a] = sum_nodes(a, row);
}

#if kept_gradients
fn sum_nodes(a: u32, row: u32) -> Mat {
    let own = displacement[a];
    let count = kept_count[a];
    var sum = Mat();
    for (var k = 0u; k < count; k++) {
        let entry = kept_neighbors[k * params.count + a];
        var other = displacement[entry & NEIGHBOR_MASK];
#if symmetry
        if (entry >> NEIGHBOR_BITS) != 0u {
            other = mirror_vector(entry >> NEIGHBOR_BITS, other);
        }
#endif
        sum += outer(other - own, kept_gradients[k * params.count + a]);
    }
    return sum;
}
#else
fn sum_nodes(a: u32, row: u32) -> Mat {
    let center = center_of(a, row);
    let own = shape_of(a);
    let displacement_a = displacement[a];
    var sum = Mat();
    for (var k = 0u; k < center.count; k++) {
        let node = node_at(center, k);
        let gradient = shape_gradient(own, node.x, node.weight, node.slope) * volume_of(node);
        sum += outer(seen(node.image, displacement[node.b]) - displacement_a, gradient);
    }
    return sum;
}
#endif
