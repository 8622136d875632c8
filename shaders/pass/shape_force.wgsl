// Acceleration, Shutov & Klyuchantsev 2019 (5) in its adjoint reading:
//
// rho a_a = T_a = -sum V_b sigma_b grad psi_a(x_b),
//
// with the gradient at b of the shape function of a; in the reference configuration P stands for sigma and V_b is the
// reference volume. Twin: src/pass/shape_force.rs
#import shape_node
#import shape_columns

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#if current
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
#endif
@group(0) @binding(_) var<storage, read> shape_stress: array<Mat>;
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;

fn of_particle(a: u32, row: u32) {
    let center = center_of(a, row);
    var sum = Vec();
    for (var k = 0u; k <= center.count; k++) {
        sum += pull(node_at(center, k));
    }
    // Present volume over reference volume, J.
#if current
    let volume = 1.0 + volumetric_strain[a];
#else
    let volume: real = 1.0;
#endif
    acceleration[a] = sum * (-volume / body_of(a).density);
}

// V_b sigma_b grad psi_a(x_b). For a mirror image, stress and gradient would all have to be mirrored. To mirror the separation
// first and the resulting force afterwards gives the same.
fn pull(node: Node) -> Vec {
    let from_a = seen(node.image, -node.x);
    let gradient = shape_gradient(shape_of(node.b), from_a, node.weight, node.slope);
    return seen(node.image, mat_vec(shape_stress[node.b], gradient)) * (reference_volume[node.b] * node.coupled);
}
