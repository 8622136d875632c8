// H_a = [sum V_b (u_b - u_a) (x) grad_a W_ab] K_a^-1, the stress P_a of the material, and what the bonds carry of
// it, P_a K_a^-1 - alpha E H_a. Twin: src/pass/deform.rs
#import linear_gradient
#import laws
#if hourglass
#import hourglass_stiffness
#endif

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#if correct_rate
@group(0) @binding(_) var<storage, read> reference_correction: array<Sym>;
#endif
#if memory
@group(0) @binding(_) var<storage, read_write> inelastic_strain: array<Sym>;
#if plastic
@group(0) @binding(_) var<storage, read_write> equivalent_plastic_strain: array<real>;
#if quasi_static
@group(0) @binding(_) var<storage, read> equilibrium_inelastic_strain: array<Sym>;
@group(0) @binding(_) var<storage, read> equilibrium_plastic_strain: array<real>;
#endif
#endif
#if heated
@group(0) @binding(_) var<storage, read_write> temperature: array<real>;
#endif
#if dissipated_energy
@group(0) @binding(_) var<storage, read_write> dissipated_energy: array<real>;
#endif
#endif
#if quadratic_gradient
@group(0) @binding(_) var<storage, read> linear_coefficient: array<Sym>;
@group(0) @binding(_) var<storage, read> quadratic_coefficient: array<Tri>;
@group(0) @binding(_) var<storage, read_write> quadratic_stress: array<Tri>;
#endif
@group(0) @binding(_) var<storage, read_write> displacement_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read_write> bond_stress: array<Mat>;

fn of_particle(a: u32, row: u32) {
    let sum = sum_bonds(a, row);
    let linear = corrected(a, sum);
#if quadratic_gradient
    let products_sum = sum_products(a, row);
    let gradient = mat_mat(sum, mat_of_sym(linear_coefficient[a])) + tri_tri(products_sum, quadratic_coefficient[a]);
#else
    let gradient = linear;
#endif
#if memory
    relax_to(a, gradient);
#endif
    displacement_gradient[a] = gradient;
    let stress = stress_of(a, gradient);
#if quadratic_gradient
    let corrected_stress = mat_mat(stress, mat_of_sym(linear_coefficient[a]));
    quadratic_stress[a] = mat_tri(stress, quadratic_coefficient[a]);
#else
    let corrected_stress = corrected(a, stress);
#endif
#if hourglass
    bond_stress[a] = corrected_stress - linear * hourglass_stiffness(a, body_of(a));
#else
    bond_stress[a] = corrected_stress;
#endif
}

#if quadratic_gradient
// sum -V_b (W'/R) (u_b - u_a) (x) X_ab X_ab
fn sum_products(a: u32, row: u32) -> Tri {
    let h = smoothing_length(a);
    let center = reference_position[a];
    let displacement_a = displacement[a];
    let count = neighbor_count[a];
    var sum = Tri();
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(center, h, neighbors[k * params.chunk + row]);
        let weight = -bond.gradient * reference_volume[bond.b];
        sum = tri_add(sum, tri_outer(displacement_difference(displacement_a, bond), sym_scale(products(bond.x), weight)));
    }
    return sum;
}
#endif

#if memory
// Takes what the law remembers to the end of the step, at the new H. Before the first step the clock's is 0.
fn relax_to(a: u32, gradient: Mat) {
    let own = body_of(a);
    let old = remembered(a);
    let memory = relax(own, gradient, old, clock.step);
    inelastic_strain[a] = memory.strain;
#if plastic
    equivalent_plastic_strain[a] = memory.plastic;
#endif
#if heated
    temperature[a] = memory.temperature;
#endif
#if dissipated_energy
    dissipated_energy[a] += dissipated(own, displacement_gradient[a], old.strain, gradient, memory.strain) * (1.0 / own.density);
#endif
}

// What the law remembers from before the step. In a descent to equilibrium, which is no motion in time, every step
// begins at the last equilibrium.
fn remembered(a: u32) -> Memory {
#if heated
    let warm = temperature[a];
#else
    let warm: real = 0.0;
#endif
#if plastic
#if quasi_static
    return Memory(equilibrium_inelastic_strain[a], equilibrium_plastic_strain[a], warm);
#else
    return Memory(inelastic_strain[a], equivalent_plastic_strain[a], warm);
#endif
#else
    return Memory(inelastic_strain[a], 0.0, warm);
#endif
}
#endif

fn stress_of(a: u32, gradient: Mat) -> Mat {
#if memory
    return first_piola(body_of(a), gradient, inelastic_strain[a]);
#else
    return first_piola(body_of(a), gradient, Sym());
#endif
}
