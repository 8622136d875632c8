// Gradient of the displacement that is exact for quadratic fields, and the stresses adjoint to it. The pass declares
// `reference_position`, `reference_volume` and `displacement`. Twin: quadratic_gradient in src/pass/deform.rs
#import displacement_difference

@group(0) @binding(_) var<storage, read> linear_coefficient: array<Sym>;
@group(0) @binding(_) var<storage, read> quadratic_coefficient: array<Tri>;

// [sum ..] C1 + [sum -V_b (W'/R) (u_b - u_a) (x) X_ab X_ab] C2, the first sum given.
fn quadratic_gradient(a: u32, row: u32, sum: Mat) -> Mat {
    let products_sum = sum_products(a, row);
    return linear_part(a, sum) + tri_tri(products_sum, quadratic_coefficient[a]);
}

// M C1
fn linear_part(a: u32, m: Mat) -> Mat {
    return mat_mat(m, mat_of_sym(linear_coefficient[a]));
}

// M C2
fn quadratic_part(a: u32, m: Mat) -> Tri {
    return mat_tri(m, quadratic_coefficient[a]);
}

// sum -V_b (W'/R) (u_b - u_a) (x) X_ab X_ab
fn sum_products(a: u32, row: u32) -> Tri {
    let h = smoothing_length(a);
    let index = body_index(a);
    let center = reference_position[a];
    let displacement_a = displacement[a];
    let count = neighbor_count[a];
    var sum = Tri();
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(index, center, h, neighbors[k * params.chunk + row]);
        let weight = -bond.gradient * reference_volume[bond.b];
        sum = tri_add(sum, tri_outer(displacement_difference(displacement_a, bond), sym_scale(products(bond.x), weight)));
    }
    return sum;
}
