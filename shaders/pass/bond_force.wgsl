// Acceleration by the bonds of the reference configuration:
//
// rho_0 a_a = sum V_b (P_a K_a^-1 + P_b K_b^-1) grad_a W_ab + hourglass force
//
// Twin: src/pass/bond_force.rs
#import displacement_difference if hourglass
#import hourglass_stiffness if hourglass
#import bond if !hourglass

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#if hourglass
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
#if plastic
#if quasi_static
@group(0) @binding(_) var<storage, read> equilibrium_plastic_strain: array<real>;
#else
@group(0) @binding(_) var<storage, read> equivalent_plastic_strain: array<real>;
#endif
#endif
#endif
@group(0) @binding(_) var<storage, read> bond_stress: array<Mat>;
#if quadratic_gradient
@group(0) @binding(_) var<storage, read> quadratic_stress: array<Tri>;
#endif
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;

fn of_particle(a: u32, row: u32) {
    acceleration[a] = sum_bonds(a, row) * (1.0 / body_of(a).density);
}

fn sum_bonds(a: u32, row: u32) -> Vec {
    let own_body = body_of(a);
    let index = body_index(a);
    let center = reference_position[a];
#if hourglass
    let displacement_a = displacement[a];
    let stiffness = hourglass_stiffness(a, own_body);
#endif
    let count = neighbor_count[a];
    // `own` is the sum of the kernel gradients alone: a's own stress multiplies it once, after the loop.
    var own = Vec();
    var others = Vec();
    let h = smoothing_length(a);
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(index, center, h, neighbors[k * params.chunk + row]);
        let weight = bond.gradient * reference_volume[bond.b];
        let x = bond.x * weight;
        own += x;
#if tied
        let far = far_weight(index, a, bond.b);
        others += mat_vec(stress_of(bond), x) * far;
#else
        others += mat_vec(stress_of(bond), x);
#endif
#if quadratic_gradient
        let products = sym_scale(products(bond.x), -weight);
#if tied
        others += tri_sym(quadratic_stress[a], products) - tri_sym(quadratic_stress[bond.b], products) * far;
#else
        others += tri_sym(tri_sub(quadratic_stress[a], quadratic_stress[bond.b]), products);
#endif
#endif
#if hourglass
#if tied
        let both = stiffness + far * hourglass_stiffness(bond.b, body_of(bond.b));
#else
#if plastic
        // Bonds join particles of one body.
        let both = stiffness + hourglass_stiffness(bond.b, own_body);
#else
        let both = 2.0 * stiffness;
#endif
#endif
        others -= displacement_difference(displacement_a, bond) * (both * weight);
#endif
    }
    return mat_vec(bond_stress[a], own) + others;
}

fn stress_of(bond: Bond) -> Mat {
#if symmetry
    if bond.image != 0u {
        return mirror_tensor(bond.image, bond_stress[bond.b]);
    }
#endif
    return bond_stress[bond.b];
}
