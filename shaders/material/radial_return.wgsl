// The deviator returned to the yield surface in the Eulerian formulation. Twin: yielded in src/material/j2.rs
#import hardening

struct Yielded {
    deviator: Sym,
    // Of the equivalent plastic strain.
    growth: real,
    // Plastic work per volume.
    work: real,
}

// sqrt(3 J2), the components on axes that the dimension lacks included.
fn mises_stress(deviator: Sym) -> real {
    let within = mat_of_sym(deviator);
    let square = trace(mat_mat(within, within));
#if line
    return sqrt(1.5 * (square + 0.5 * deviator * deviator));
#endif
#if plane
    let rest = sym_trace(deviator);
    return sqrt(1.5 * (square + rest * rest));
#endif
#if solid
    return sqrt(1.5 * square);
#endif
}

fn yielded(body: Body, deviator: Sym, k: real) -> Yielded {
    let trial = mises_stress(deviator);
    let before = yield_stress(body, k).stress;
    if body.yield_stress == 0.0 || trial <= before {
        return Yielded(deviator, 0.0, 0.0);
    }
    let stiffness = 3.0 * body.shear_modulus;
    let growth = increment(body, trial, k, stiffness);
    let lost = stiffness * growth;
    return Yielded(sym_scale(deviator, 1.0 - lost / trial), growth, 0.5 * (before + trial - lost) * growth);
}
