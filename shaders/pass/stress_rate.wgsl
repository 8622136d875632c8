// Rates of volumetric strain, Fuller (2.21), and of deviatoric stress, (2.45), for the Runge-Kutta stages.
// Twin: src/pass/stress_rate.rs
#import params
#import body if shear
#import deviatoric_rate if shear

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> velocity_gradient: array<Mat>;
#if shear
@group(0) @binding(_) var<storage, read> deviatoric_stress: array<Sym>;
@group(0) @binding(_) var<storage, read_write> deviatoric_stress_rate: array<Sym>;
#endif
#if continuity
@group(0) @binding(_) var<storage, read> volumetric_strain: array<real>;
@group(0) @binding(_) var<storage, read_write> volumetric_strain_rate: array<real>;
#endif

fn of_particle(a: u32) {
    let gradient = velocity_gradient[a];
#if shear
    let spun = mat_mat(skew_part(gradient), mat_of_sym(deviatoric_stress[a]));
    // Omega S - S Omega is twice the symmetric part of Omega S.
    let rotation = sym_scale(sym_part(spun), 2.0);
    deviatoric_stress_rate[a] = sym_add(deviatoric_rate(body_of(a).shear_modulus, gradient), rotation);
#endif
#if continuity
    volumetric_strain_rate[a] = (1.0 + volumetric_strain[a]) * trace(gradient);
#endif
}
