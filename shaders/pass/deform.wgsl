// H_a = [sum V_b (u_b - u_a) (x) grad_a W_ab] K_a^-1, the stress P_a of the material, and what the bonds carry of
// it, P_a K_a^-1 - alpha E H_a. Twin: src/pass/deform.rs
#import invocation
#import displacement_difference
#import laws

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
#if correct_rate
@group(0) @binding(_) var<storage, read> reference_correction: array<Sym>;
#endif
#if memory
@group(0) @binding(_) var<storage, read_write> viscous_strain: array<Sym>;
#if dissipated_energy
@group(0) @binding(_) var<storage, read_write> dissipated_energy: array<real>;
#endif
#endif
@group(0) @binding(_) var<storage, read_write> displacement_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read_write> bond_stress: array<Mat>;

@compute @workgroup_size(64)
fn main(invocation: Invocation) {
    let row = index_of(invocation);
    if row >= params.chunk || clock.running == 0u {
        return;
    }
    let a = params.first + row;
    let gradient = displacement_gradient_of(a, row);
#if memory
    relax_to(a, gradient);
#endif
    displacement_gradient[a] = gradient;
    bond_stress[a] = bond_stress_of(a, gradient);
}

fn displacement_gradient_of(a: u32, row: u32) -> Mat {
    let h = body_of(a).smoothing_length;
    let center = reference_position[a];
    let displacement_a = displacement[a];
    let count = neighbor_count[a];
    var sum = Mat();
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(center, h, neighbors[k * params.chunk + row]);
        let weight = bond.gradient * reference_volume[bond.b];
        sum += outer(displacement_difference(displacement_a, bond), bond.x * weight);
    }
    return corrected(a, sum);
}

// M K_a^-1
fn corrected(a: u32, m: Mat) -> Mat {
#if correct_rate
    return mat_mat(m, mat_of_sym(reference_correction[a]));
#else
    return m;
#endif
}

#if memory
// Takes what the law remembers to the end of the step, at the new H. Before the first step the clock's is 0.
fn relax_to(a: u32, gradient: Mat) {
    let own = body_of(a);
    let old = viscous_strain[a];
    let memory = relax(own, gradient, old, clock.step);
    viscous_strain[a] = memory;
#if dissipated_energy
    dissipated_energy[a] += dissipated(own, displacement_gradient[a], old, gradient, memory) * (1.0 / own.density);
#endif
}
#endif

fn bond_stress_of(a: u32, gradient: Mat) -> Mat {
    let own = body_of(a);
#if memory
    let stress = first_piola(own, gradient, viscous_strain[a]);
#else
    let stress = first_piola(own, gradient, Sym());
#endif
#if hourglass
    return corrected(a, stress) - gradient * (params.hourglass * own.youngs_modulus);
#else
    return corrected(a, stress);
#endif
}
