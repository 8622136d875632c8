// Stress in the form that the pair force sums: sigma/rho^2 (plain) or sigma K^-1 (adjoint), and the artificial
// stress R. Twin: src/pass/specific_stress.rs
#import body
#import pressures
#import body_options if artificial_stress

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
#if shear
@group(0) @binding(_) var<storage, read> deviatoric_stress: array<Sym>;
#endif
#if adjoint
@group(0) @binding(_) var<storage, read> correction: array<Mat>;
@group(0) @binding(_) var<storage, read_write> corrected_stress: array<Mat>;
#else
@group(0) @binding(_) var<storage, read_write> specific_stress: array<Sym>;
#endif
#if scalar_form
@group(0) @binding(_) var<storage, read_write> artificial_pressure: array<real>;
#endif
#if principal_form
@group(0) @binding(_) var<storage, read_write> artificial_stress: array<Sym>;
#endif

fn of_particle(a: u32) {
    let own = body_of(a);
    let strain = volumetric_strain[a];
    let pressure_a = -kirchhoff(own, strain) / (1.0 + strain);
    let stress_a = stress(a, pressure_a);
    // 1/rho^2
    let specific_volume = 1.0 / (own.density / (1.0 + strain));
    let square_of_volume = specific_volume * specific_volume;
#if adjoint
    corrected_stress[a] = mat_mat(mat_of_sym(stress_a), correction[a]);
#else
    specific_stress[a] = sym_scale(stress_a, square_of_volume);
#endif
#if scalar_form
    artificial_pressure[a] = -options_of(a).artificial_epsilon * max(-pressure_a, 0.0) * square_of_volume;
#endif
#if principal_form
    artificial_stress[a] = sym_scale(tensile_part(stress_a), -options_of(a).artificial_epsilon * square_of_volume);
#endif
}

// sigma = -P 1 + S, Fuller (2.29) with the sign mended.
fn stress(a: u32, pressure_a: real) -> Sym {
#if shear
    return sym_add(diagonal(-pressure_a), deviatoric_stress[a]);
#else
    return diagonal(-pressure_a);
#endif
}

#if principal_form
// The tensor with its compressive principal values set to zero: Gray, Monaghan & Swift 2001. Jacobi rotations:
// in the plane one is exact; in space a few sweeps reach rounding. A driver's atan2 is only good to five digits.
#if line
fn tensile_part(stress: Sym) -> Sym {
    return max(stress, 0.0);
}
#else
const SWEEPS: u32 = 5u;

fn tensile_part(stress: Sym) -> Sym {
    var m = mat_of_sym(stress);
    var axes = mat_identity();
#if plane
    jacobi(&m, &axes, 0u, 1u);
#else
    for (var sweep = 0u; sweep < SWEEPS; sweep++) {
        jacobi(&m, &axes, 0u, 1u);
        jacobi(&m, &axes, 0u, 2u);
        jacobi(&m, &axes, 1u, 2u);
    }
#endif
    var kept = Mat();
    for (var k = 0u; k < DIMENSION; k++) {
        kept[k][k] = max(m[k][k], 0.0);
    }
    return sym_part(mat_mat(mat_mat(axes, kept), transpose_mat(axes)));
}

// One rotation in the plane of axes p and q that clears the component (p, q).
fn jacobi(m: ptr<function, Mat>, axes: ptr<function, Mat>, p: u32, q: u32) {
    let shear = (*m)[q][p];
    if shear == 0.0 {
        return;
    }
    let theta = ((*m)[q][q] - (*m)[p][p]) / (2.0 * shear);
    let sign_of_theta = select(1.0, -1.0, theta < 0.0);
    let tangent = sign_of_theta / (abs(theta) + sqrt(theta * theta + 1.0));
    let cosine = 1.0 / sqrt(tangent * tangent + 1.0);
    let sine = tangent * cosine;
    var rotation = mat_identity();
    rotation[p][p] = cosine;
    rotation[q][q] = cosine;
    rotation[q][p] = sine;
    rotation[p][q] = -sine;
    *m = mat_mat(mat_mat(transpose_mat(rotation), *m), rotation);
    *axes = mat_mat(*axes, rotation);
}
#endif
#endif
