// Strains that keep their digits when small, and tensors of space where the dimension lacks axes.
// Twin: src/material/strain.rs
#import tensor

// A symmetric tensor of space. Across the axes that the dimension lacks it has one component on each.
struct Whole {
    within: Sym,
    across: real,
}

// Number of axes that the dimension lacks.
const LACKING: real = real(3u - DIMENSION);

// det(1 + M) - 1
fn volume_change(m: Mat) -> real {
#if line
    return m;
#endif
#if plane
    return trace(m) + determinant_mat(m);
#endif
#if solid
    return trace(m) + trace(adjugate(m)) + determinant_mat(m);
#endif
}

// (1 + x)^(1/3) - 1 by Halley's iteration on c (3 + 3 c + c^2) = x.
fn cube_root_change(x: real) -> real {
    var c: real = 0.0;
    for (var k = 0u; k < 5u; k++) {
        let excess = c * (3.0 + c * (3.0 + c)) - x;
        c -= (1.0 + c) * excess / (3.0 * (1.0 + x) + 2.0 * excess);
    }
    return c;
}

// J^(-2/3) - 1 from J - 1.
fn isochoric_change(volume_change: real) -> real {
    let c = cube_root_change(volume_change);
    let root = 1.0 + c;
    return -c * (2.0 + c) / (root * root);
}

// J^5 - 1 from J - 1.
fn fifth_power_change(j: real) -> real {
    return j * (5.0 + j * (10.0 + j * (10.0 + j * (5.0 + j))));
}

// C - 1 = H + H^T + H^T H
fn right_strain(h: Mat) -> Sym {
    return sym_add(sym_scale(sym_part(h), 2.0), sym_part(mat_mat(transpose_mat(h), h)));
}

// J^(-2/3) C - 1
fn unimodular_strain(h: Mat) -> Whole {
    let change = isochoric_change(volume_change(h));
    return Whole(sym_add(sym_scale(right_strain(h), 1.0 + change), diagonal(change)), change);
}

// (1 + M)^-1
fn inverse_of_unit_and(m: Mat) -> Mat {
    return adjugate(mat_identity() + m) * (1.0 / (1.0 + volume_change(m)));
}
