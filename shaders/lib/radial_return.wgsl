// The deviator returned to the yield surface in the Eulerian formulation. Twin: yielded in src/material/yielding.rs
#import yielding

struct Yielded {
    deviator: Sym,
    // Of the equivalent plastic strain.
    growth: real,
    // Plastic work per reference volume.
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

fn yielded(body: Body, deviator: Sym, strain: real, temperature: real, volume: real, step: real) -> Yielded {
    if body.yield_stress == 0.0 {
        return Yielded(deviator, 0.0, 0.0);
    }
    let stiffness = 3.0 * body.shear_modulus;
    let trial = Trial(mises_stress(deviator), strain, temperature, stiffness, step, volume);
    let rest = trial_rest(body, trial);
    if trial.stress <= rest.stress {
        return Yielded(deviator, 0.0, 0.0);
    }
    let growth = increment(body, trial, rest);
    let lost = stiffness * growth;
    let work = 0.5 * (trial_begin(body, trial, growth) + trial.stress - lost) * growth * volume;
    return Yielded(sym_scale(deviator, 1.0 - lost / trial.stress), growth, work);
}
