// Advances volumetric strain and deviatoric stress by one step of leapfrog, from the velocity gradient at the
// middle of the step. Twin: src/pass/stress.rs
//
// The rotation is Cayley's, Q = (1 - A/2)^-1 (1 + A/2) with A = step Omega (Hughes & Winget 1980).
#import params
#import body if shear
#import deviatoric_rate if shear
#import radial_return if plastic
#import temperature if plastic

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> velocity_gradient: array<Mat>;
#if shear
@group(0) @binding(_) var<storage, read_write> deviatoric_stress: array<Sym>;
#endif
#if continuity
@group(0) @binding(_) var<storage, read_write> volumetric_strain: array<real>;
#else
#if plastic
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
#endif
#endif
#if plastic
@group(0) @binding(_) var<storage, read_write> equivalent_plastic_strain: array<real>;
#if dissipated_energy
@group(0) @binding(_) var<storage, read_write> dissipated_energy: array<real>;
#endif
#endif

fn of_particle(a: u32) {
    let gradient = middle_gradient(velocity_gradient[a]);
#if shear
    let half = sym_scale(deviatoric_rate(body_of(a).shear_modulus, gradient), 0.5 * clock.step);
    let rotated = rotate(sym_add(deviatoric_stress[a], half), skew_part(gradient) * clock.step);
    deviatoric_stress[a] = sym_add(rotated, half);
#endif
#if plastic
    yield_to(a);
#endif
#if continuity
    // Crank-Nicolson of J' = J tr L, written for J - 1 so that f32 keeps small strains.
    let growth = trace(gradient) * clock.step;
    let strain = volumetric_strain[a];
    volumetric_strain[a] = strain + (1.0 + strain) * growth / (1.0 - 0.5 * growth);
#endif
}

#if plastic
// Returns stress to the yield surface.
fn yield_to(a: u32) {
    let own = body_of(a);
    let warm = temperature_of(a);
    let result = yielded(own, deviatoric_stress[a], equivalent_plastic_strain[a], warm, 1.0 + volumetric_strain[a], clock.step);
    deviatoric_stress[a] = result.deviator;
    equivalent_plastic_strain[a] += result.growth;
#if heated
    set_temperature(a, warm + rise(own, result.work));
#endif
#if dissipated_energy
    dissipated_energy[a] += result.work * (1.0 / own.density);
#endif
}
#endif

// The plain gradient is divided by the density of the step's start; here by that of its middle, without which
// leapfrog is of first order where strains are finite.
fn middle_gradient(gradient: Mat) -> Mat {
#if correct_rate
    return gradient;
#else
    return gradient * (1.0 / (1.0 - 0.5 * trace(gradient) * clock.step));
#endif
}

#if shear
// Q S Q^T with Q = 1 + (A + A A/2)/(1 + |a|^2/4), |a|^2 = A:A/2: Cayley's rotation in closed form.
fn rotate(stress: Sym, turn: Mat) -> Sym {
    let square = mat_mat(turn, turn);
    let angle_square = -0.5 * trace(square);
    let scale = 1.0 / (1.0 + 0.25 * angle_square);
    let q = mat_identity() + (turn + square * 0.5) * scale;
    return sym_part(mat_mat(mat_mat(q, mat_of_sym(stress)), transpose_mat(q)));
}
#endif
