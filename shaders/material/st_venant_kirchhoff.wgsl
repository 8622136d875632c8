// Stress linear in Green's strain: S = lambda tr E + 2 mu E, E = (H + H^T + H^T H)/2, P = (1 + H) S.
// Twin: src/material/st_venant_kirchhoff.rs
#import params

fn first_piola_st_venant_kirchhoff(body: Body, h: Mat) -> Mat {
    let strain = sym_add(sym_part(h), sym_scale(sym_part(mat_mat(transpose_mat(h), h)), 0.5));
    let lambda = body.bulk_modulus - body.shear_modulus * (2.0 / 3.0);
    let stress = mat_of_sym(sym_add(sym_scale(strain, 2.0 * body.shear_modulus), diagonal(lambda * sym_trace(strain))));
    return stress + mat_mat(h, stress);
}
