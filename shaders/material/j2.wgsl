// Metal plasticity of von Mises: elasticity as of maxwell.wgsl, C_i = C_p, and a flow that stops where the Mises
// stress q is at the yield stress. A step ends at the unimodular part of C_p + w C', w found from q = sY.
// Twin: src/material/j2.rs
#import params
#import strain
#import memory
#import maxwell
#import hardening

// Rounds that make q = sY.
const J2_ROUNDS: u32 = 5u;

// Of A = C_p C'^-1: tr A/3, tr A^D A^D, det A^D.
struct Invariants {
    mean: real,
    square: real,
    cube: real,
}

// q/mu and rho of b_e = rho (A + w)^-1.
struct Mises {
    ratio: real,
    rho: real,
}

fn invariants_of(strain: Mixed) -> Invariants {
    let deviator = mixed_deviator(strain);
    let mean = 1.0 + mixed_trace(strain) * (1.0 / 3.0);
    return Invariants(mean, mixed_inner(deviator, deviator), mixed_determinant(deviator));
}

// With m = mean + w, the deviator of the inverse is (-m D + D D - D:D/3)/det.
fn mises_of(a: Invariants, w: real) -> Mises {
    let m = a.mean + w;
    let part = (a.cube / m - 0.5 * a.square) / (m * m);
    let rho = m * (1.0 + cube_root_change(part));
    let norm = a.square * (m * m + a.square * (1.0 / 6.0)) - 6.0 * m * a.cube;
    return Mises(sqrt(1.5 * max(norm, 0.0)) / (rho * rho), rho);
}

fn first_piola_j2(body: Body, h: Mat, memory: Sym) -> Mat {
    return first_piola_maxwell(body, h, memory);
}

// C_p - 1 and k after a step that ends at H.
fn relax_j2(body: Body, h: Mat, memory: Memory, step: real) -> Memory {
    let mu = body.shear_modulus;
    let total = unimodular_strain(h);
    let k = memory.plastic;
    let invariants = invariants_of(over(whole(memory.strain), total, total));
    let trial = mu * mises_of(invariants, 0.0).ratio;
    if trial <= yield_stress(body, k).stress {
        return memory;
    }
    let stiffness = 3.0 * mu;
    var growth = increment(body, trial, k, stiffness);
    var w = stiffness * growth / (trial - stiffness * growth);
    for (var round = 0u; round < J2_ROUNDS; round++) {
        let mises = mises_of(invariants, w);
        let q = mu * mises.ratio;
        growth = w * sqrt(trial * q / mises.rho) / stiffness;
        let wanted = yield_stress(body, k + growth);
        let excess = (q - wanted.stress) * stiffness / (stiffness + wanted.slope);
        w += (1.0 + w) * excess / (q - excess);
    }
    return Memory(relaxed(h, memory.strain, w), k + growth);
}

fn dissipated_j2(body: Body, old_h: Mat, old_memory: Sym, h: Mat, memory: Sym) -> real {
    return dissipated_maxwell(body, old_h, old_memory, h, memory);
}
