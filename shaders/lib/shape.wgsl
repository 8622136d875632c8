// Correction of the kernel at a point, psi_b(x) = alpha (1 + beta . r) W(r), r = x - x_b.
// Twin: Shape in src/shape_function.rs
#import tensor

struct Shape {
    // alpha
    factor: real,
    // beta
    slope: Vec,
    factor_gradient: Vec,
    // Component (i, j): d beta_i/dx_j
    slope_gradient: Mat,
}

// Gradient of psi_b, x from b to here, with W and W'/r.
fn shape_gradient(own: Shape, x: Vec, weight: real, slope: real) -> Vec {
    let tilt = 1.0 + inner(own.slope, x);
    let turned = mat_vec(transpose_mat(own.slope_gradient), x) + own.slope;
    return x * (own.factor * tilt * slope) + own.factor_gradient * (weight * tilt) + turned * (own.factor * weight);
}
