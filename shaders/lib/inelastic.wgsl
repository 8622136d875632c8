// Elasticity beside an inelastic strain that is remembered, C_i - 1: neo-Hookean in what C has more than C_i.
//
// With X = C' C_i^-1 - 1 = (C' - C_i) C_i^-1, C' = J^(-2/3) C: P = F T = F^-T (mu X^D + tau_m 1), tau_m the mean
// Kirchhoff stress. Twin: src/material/inelastic.rs
#import params
#import strain

// A tensor of space without symmetry, laid out as `Whole`.
struct Mixed {
    within: Mat,
    across: real,
}

fn mixed_trace(m: Mixed) -> real {
    return trace(m.within) + LACKING * m.across;
}

// tr (A B)
fn mixed_inner(a: Mixed, b: Mixed) -> real {
    return trace(mat_mat(a.within, b.within)) + LACKING * a.across * b.across;
}

// A - tr A/3
fn mixed_deviator(m: Mixed) -> Mixed {
    let third = mixed_trace(m) * (1.0 / 3.0);
    return Mixed(m.within - mat_of_sym(diagonal(third)), m.across - third);
}

fn mixed_determinant(m: Mixed) -> real {
#if line
    return determinant_mat(m.within) * m.across * m.across;
#endif
#if plane
    return determinant_mat(m.within) * m.across;
#endif
#if solid
    return determinant_mat(m.within);
#endif
}

// C_i - 1 with the components that det C_i = 1 asks for.
fn whole(memory: Sym) -> Whole {
    let change = volume_change(mat_of_sym(memory));
#if line
    let root = sqrt(1.0 + change);
    return Whole(memory, -change / (root * (1.0 + root)));
#endif
#if plane
    return Whole(memory, -change / (1.0 + change));
#endif
#if solid
    return Whole(memory, 0.0);
#endif
}

// (A - B) (1 + V)^-1 of the strains A, B and V.
fn over(a: Whole, b: Whole, v: Whole) -> Mixed {
    let inverse = inverse_of_unit_and(mat_of_sym(v.within));
    return Mixed(mat_mat(mat_of_sym(sym_sub(a.within, b.within)), inverse), (a.across - b.across) / (1.0 + v.across));
}

// X
fn elastic_strain(h: Mat, memory: Sym) -> Mixed {
    let viscous = whole(memory);
    return over(unimodular_strain(h), viscous, viscous);
}

// First Piola-Kirchhoff stress with a mean Kirchhoff stress.
fn first_piola_inelastic(body: Body, h: Mat, memory: Sym, kirchhoff: real) -> Mat {
    let strain = elastic_strain(h, memory);
    let mean = kirchhoff - body.shear_modulus * (1.0 / 3.0) * mixed_trace(strain);
    let stress = strain.within * body.shear_modulus + mat_of_sym(diagonal(mean));
    return mat_mat(transpose_mat(inverse_of_unit_and(h)), stress);
}

// The unimodular part of C_i + weight C', less 1.
fn relaxed(h: Mat, memory: Sym, weight: real) -> Sym {
    let total = unimodular_strain(h);
    let viscous = whole(memory);
    let share = 1.0 / (1.0 + weight);
    let mean = sym_scale(sym_add(viscous.within, sym_scale(total.within, weight)), share);
    let within = volume_change(mat_of_sym(mean));
    let lacking = (viscous.across + total.across * weight) * share;
#if line
    let across = lacking * (2.0 + lacking);
#endif
#if plane
    let across = lacking;
#endif
#if solid
    let across: real = 0.0;
#endif
    let root = cube_root_change(within + across + within * across);
    let change = -root / (1.0 + root);
    return sym_add(sym_scale(mean, 1.0 + change), diagonal(change));
}

// Heat of one step, per reference volume: the trapezoid of -d psi/dC_i over the change of C_i as it was made.
fn dissipated_inelastic(body: Body, old_h: Mat, old_memory: Sym, h: Mat, memory: Sym) -> real {
    let begin = whole(old_memory);
    let end = whole(memory);
    let first = mixed_inner(elastic_strain(old_h, old_memory), over(end, begin, begin));
    let last = mixed_inner(elastic_strain(h, memory), over(end, begin, end));
    return 0.25 * body.shear_modulus * (first + last);
}
