// Compressible neo-Hookean body, Shutov & Klyuchantsev 2019 (11): tau = mu J^(-2/3) B^D + k/10 (J^5 - J^-5) 1,
// P = tau F^-T.
// Twin: src/material/neo_hookean.rs
#import params
#import strain
#import volumetric_stress

fn first_piola_neo_hookean(body: Body, h: Mat, memory: Sym) -> Mat {
    let change = volume_change(h);
    // B is C of the transpose.
    let strain = right_strain(transpose_mat(h));
    let deviator = sym_sub(strain, diagonal(sym_trace(strain) * (1.0 / 3.0)));
    let shear_modulus = body.shear_modulus * (1.0 + isochoric_change(change));
    let stress = sym_add(sym_scale(deviator, shear_modulus), diagonal(volumetric_stress(body.bulk_modulus, change)));
    return mat_mat(mat_of_sym(stress), transpose_mat(inverse_of_unit_and(h)));
}
