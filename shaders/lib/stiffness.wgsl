// By how much a deformation raises the largest stiffness against plane waves. Twin: src/material/stiffening.rs
#import params
#import strain

const DENSER: real = 0.01;

fn denser(change: real) -> real {
    return change - DENSER * (1.0 + change);
}

// The smallest eigenvalue of C - 1.
fn least_strain(h: Mat) -> real {
    let strain = mat_of_sym(right_strain(h));
#if line
    return trace(strain);
#endif
#if plane
    let half = 0.5 * trace(strain);
    return half - sqrt(max(half * half - determinant_mat(strain), 0.0));
#endif
#if solid
    return least_root(trace(strain), trace(adjugate(strain)), determinant_mat(strain));
#endif
}

// The smallest root of x^3 - t x^2 + s x - q, by Laguerre's iteration from below.
fn least_root(t: real, s: real, q: real) -> real {
    var x: real = -1.0;
    for (var k = 0u; k < 6u; k++) {
        let value = ((x - t) * x + s) * x - q;
        if value >= 0.0 {
            break;
        }
        let first = ((3.0 * x - 2.0 * t) * x + s) / value;
        let second = first * first - 2.0 * (3.0 * x - t) / value;
        let rate = first - sqrt(max(2.0 * (3.0 * second - first * first), 0.0));
        if rate >= 0.0 {
            break;
        }
        x = min(x - 3.0 / rate, t * (1.0 / 3.0));
    }
    return x;
}

fn by_volume(body: Body, h: Mat, mean: real, at_denser: real) -> real {
    let least = 1.0 + least_strain(h);
    let volumetric = ((mean - at_denser) * (1.0 / DENSER) - mean) / body.bulk_modulus;
    let trace = 3.0 + sym_trace(right_strain(h));
    var deviatoric: real = 0.0;
    if body.shear_modulus > 0.0 {
        deviatoric = (1.0 + isochoric_change(volume_change(h))) * (5.0 / 12.0 * trace - 0.25 * least);
    }
    if body.yield_stress > 0.0 {
        deviatoric = min(deviatoric, 1.0 + 0.75 * body.yield_stress / body.shear_modulus);
    }
    return max(volumetric, deviatoric) / least;
}

fn by_stretch(h: Mat) -> real {
    let others = (2.0 - LACKING) * least_strain(h);
    return 1.0 + 1.5 * (sym_trace(right_strain(h)) - others);
}
