// Coefficients of the gradient that is exact for quadratic displacements. Twin: src/pass/correct_quadratic.rs
#import bond

@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> reference_correction: array<Sym>;
@group(0) @binding(_) var<storage, read_write> linear_coefficient: array<Sym>;
@group(0) @binding(_) var<storage, read_write> quadratic_coefficient: array<Tri>;

// A pivot below this part of the largest: the neighbours do not define the fit.
const SMALLEST_PIVOT: real = 1e-3;

fn of_particle(a: u32, row: u32) {
    let h = smoothing_length(a);
    var moment = moment_of(a, row, h);
    if invert(&moment) {
        linear_coefficient[a] = sym_of_terms(&moment, 1.0 / (h * h));
        quadratic_coefficient[a] = tri_of_terms(&moment, 1.0 / (h * h * h));
    } else {
        // Too few neighbours define the quadratic part: the linear fit.
        linear_coefficient[a] = reference_correction[a];
        quadratic_coefficient[a] = Tri();
    }
}

// sum w p (x) p with lengths in units of h, so that its numbers are alike.
fn moment_of(a: u32, row: u32, h: real) -> array<real, TERMS * TERMS> {
    let index = body_index(a);
    let center = reference_position[a];
    let count = neighbor_count[a];
    var moment = array<real, TERMS * TERMS>();
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(index, center, h, neighbors[k * params.chunk + row]);
        let weight = bond.gradient * reference_volume[bond.b];
        let d = bond.x * (-1.0 / h);
        let pairs = products(d);
        for (var i = 0u; i < TERMS; i++) {
            let first = weight * term(d, pairs, i);
            for (var j = 0u; j < TERMS; j++) {
                moment[i * TERMS + j] -= first * term(d, pairs, j);
            }
        }
    }
    return moment;
}

// Gauss-Jordan without exchange of rows: the matrix is symmetric and positive.
fn invert(m: ptr<function, array<real, TERMS * TERMS>>) -> bool {
    var largest: real = 0.0;
    for (var k = 0u; k < TERMS; k++) {
        largest = max(largest, (*m)[k * TERMS + k]);
    }
    for (var k = 0u; k < TERMS; k++) {
        let pivot = (*m)[k * TERMS + k];
        if pivot <= largest * SMALLEST_PIVOT {
            return false;
        }
        (*m)[k * TERMS + k] = 1.0;
        for (var column = 0u; column < TERMS; column++) {
            (*m)[k * TERMS + column] *= 1.0 / pivot;
        }
        for (var row = 0u; row < TERMS; row++) {
            if row != k {
                subtract_row(m, row, k);
            }
        }
    }
    return true;
}

fn subtract_row(m: ptr<function, array<real, TERMS * TERMS>>, row: u32, k: u32) {
    let factor = (*m)[row * TERMS + k];
    (*m)[row * TERMS + k] = 0.0;
    for (var column = 0u; column < TERMS; column++) {
        (*m)[row * TERMS + column] -= factor * (*m)[k * TERMS + column];
    }
}
