// Metal plasticity at finite strain: elasticity as of inelastic.wgsl, C_i = C_p, and a flow that stops where the Mises
// stress q is what the strength bears. A step ends at the unimodular part of C_p + w C', w found from it.
// Twin: relax in src/material/yielding.rs
#import inelastic
#import memory
#import yielding

// Rounds that bring the Mises stress q to the flow stress sY.
const FINITE_ROUNDS: u32 = 5u;
// And at most, where strains or rates are large.
const MOST_FINITE_ROUNDS: u32 = 40u;

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

// The memory after a step that ends at H.
fn relax_to_yield(body: Body, h: Mat, memory: Memory, step: real) -> Memory {
    if body.yield_stress == 0.0 {
        return memory;
    }
    let mu = body.shear_modulus;
    let total = unimodular_strain(h);
    let invariants = invariants_of(over(whole(memory.strain), total, total));
    let stiffness = 3.0 * mu;
    let trial = Trial(mu * mises_of(invariants, 0.0).ratio, memory.plastic, memory.temperature, stiffness, step, 1.0);
    let rest = trial_rest(body, trial);
    if trial.stress <= rest.stress {
        return memory;
    }
    var growth = increment(body, trial, rest);
    var w = stiffness * growth / (trial.stress - stiffness * growth);
    var at = Point(trial.strain, 0.0, trial.temperature);
    // The root lies between the largest w that was too small and the smallest that was too large.
    var low: real = 0.0;
    var high: real = 1e30;
    for (var round = 1u; round <= MOST_FINITE_ROUNDS; round++) {
        let mises = mises_of(invariants, w);
        let q = mu * mises.ratio;
        growth = w * sqrt(trial.stress * q / mises.rho) / stiffness;
        at = trial_point(body, trial, growth, trial_begin(body, trial, growth), q);
        let wanted = flow(body, at);
        let excess = (q - wanted.stress) * stiffness / (stiffness + trial_slope(trial, wanted));
        if q > wanted.stress {
            low = w;
        } else {
            high = w;
        }
        w += (1.0 + w) * excess / (q - excess);
        if w < low || w > high {
            w = 0.5 * (low + high);
        }
        if round >= FINITE_ROUNDS && abs(q - wanted.stress) <= RETURN_ROUNDING * q {
            break;
        }
    }
    return Memory(relaxed(h, memory.strain, w), memory.plastic + growth, at.temperature);
}
