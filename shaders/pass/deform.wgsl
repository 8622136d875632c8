// H_a = [sum V_b (u_b - u_a) (x) grad_a W_ab] K_a^-1, the stress P_a of the material, and what the bonds carry of
// it, P_a K_a^-1 - alpha E H_a. Twin: src/pass/deform.rs
#import linear_gradient
#import laws
#import quadratic_gradient if quadratic_gradient
#import relaxation if memory
#import hourglass_stiffness if hourglass

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read_write> displacement_gradient: array<Mat>;
@group(0) @binding(_) var<storage, read_write> bond_stress: array<Mat>;
#if quadratic_gradient
@group(0) @binding(_) var<storage, read_write> quadratic_stress: array<Tri>;
#endif

fn of_particle(a: u32, row: u32) {
    let sum = sum_bonds(a, row);
    let linear = corrected(a, sum);
#if quadratic_gradient
    let gradient = quadratic_gradient(a, row, sum);
#else
    let gradient = linear;
#endif
#if memory
    relax_to(a, gradient);
    let memory = inelastic_strain[a];
#else
    let memory = Sym();
#endif
    displacement_gradient[a] = gradient;
    let stress = first_piola(body_of(a), gradient, memory);
#if quadratic_gradient
    var carried = linear_part(a, stress);
    quadratic_stress[a] = quadratic_part(a, stress);
#else
    var carried = corrected(a, stress);
#endif
#if hourglass
    carried -= linear * hourglass_stiffness(a, body_of(a));
#endif
    bond_stress[a] = carried;
}
