// Gradient of the displacement that is exact for linear fields. The pass declares `reference_position`,
// `reference_volume` and `displacement`. Twins: sum_bonds, corrected in src/pass/deform.rs
#import displacement_difference

// sum V_b (u_b - u_a) (x) grad_a W_ab
fn sum_bonds(a: u32, row: u32) -> Mat {
    let h = smoothing_length(a);
    let index = body_index(a);
    let center = reference_position[a];
    let displacement_a = displacement[a];
    let count = neighbor_count[a];
    var sum = Mat();
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(index, center, h, neighbors[k * params.chunk + row]);
        let weight = bond.gradient * reference_volume[bond.b];
        sum += outer(displacement_difference(displacement_a, bond), bond.x * weight);
    }
    return sum;
}

// M K_a^-1, or M where the gradient is the plain one.
#if correct_rate
@group(0) @binding(_) var<storage, read> reference_correction: array<Sym>;

fn corrected(a: u32, m: Mat) -> Mat {
    return mat_mat(m, mat_of_sym(reference_correction[a]));
}
#else
fn corrected(a: u32, m: Mat) -> Mat {
    return m;
}
#endif
