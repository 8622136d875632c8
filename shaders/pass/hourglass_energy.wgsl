// Energy of the hourglass term of one particle, V_a (alpha E/2) sum V_b w |H_a X_ab - u_ab|^2 with w = -W'(R)/R and
// the linear H. Twin: src/pass/hourglass_energy.rs
#import linear_gradient
#import hourglass_stiffness

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
#if plastic
#if quasi_static
@group(0) @binding(_) var<storage, read> equilibrium_plastic_strain: array<real>;
#else
@group(0) @binding(_) var<storage, read> equivalent_plastic_strain: array<real>;
#endif
#endif
@group(0) @binding(_) var<storage, read_write> hourglass_energy: array<real>;

fn of_particle(a: u32, row: u32) {
    let own_body = body_of(a);
    let index = body_index(a);
    let center = reference_position[a];
    let displacement_a = displacement[a];
    let gradient = corrected(a, sum_bonds(a, row));
    let count = neighbor_count[a];
    var sum: real = 0.0;
    let h = smoothing_length(a);
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(index, center, h, neighbors[k * params.chunk + row]);
        let stray = displacement_difference(displacement_a, bond) + mat_vec(gradient, bond.x);
        sum += inner(stray, stray) * (-bond.gradient * reference_volume[bond.b]);
    }
    hourglass_energy[a] = 0.5 * hourglass_stiffness(a, own_body) * reference_volume[a] * sum;
}
