// Stress linear in Green's strain: S = lambda tr E 1 + 2 mu E, E = (C - 1)/2, P = (1 + H) S.
// Twin: src/material/st_venant_kirchhoff.rs
#import params
#import strain

fn first_piola_st_venant_kirchhoff(body: Body, h: Mat, memory: Sym) -> Mat {
    let strain = right_strain(h);
    let lambda = body.bulk_modulus - body.shear_modulus * (2.0 / 3.0);
    let volumetric = lambda * 0.5 * sym_trace(strain);
    let stress = mat_of_sym(sym_add(sym_scale(strain, body.shear_modulus), diagonal(volumetric)));
    return stress + mat_mat(h, stress);
}
