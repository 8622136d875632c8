// Inverses of moment matrices. Twins: inverse_or, safe_inverse in src/pair.rs
#import tensor

// Smallest determinant, over the mean principal moment to the power of the dimension, of a matrix that is inverted.
const LEAST_DETERMINANT: real = 1e-3;

// Inverse of a moment matrix, or `otherwise` where the neighbours lie on a line or a plane. The principal moments may be small,
// as at the corner of a cube, if they are of the same size.
fn inverse_or(moment: Mat, otherwise: Mat) -> Mat {
    let mean = trace(moment) * (1.0 / real(DIMENSION));
    var least = LEAST_DETERMINANT;
    for (var k = 0u; k < DIMENSION; k++) {
        least *= mean;
    }
    let determinant = determinant_mat(moment);
    if determinant > least {
        return adjugate(moment) * (1.0 / determinant);
    }
    return otherwise;
}

// A particle of a body that tears may keep few neighbours: below this the correction amplifies noise. In space the
// edges of a body are below it too, where h is large.
const SMALLEST_DETERMINANT: real = 0.02;

// Inverse of a moment matrix, or the unit tensor where too few neighbours are left to define one.
fn safe_inverse(moment: Mat) -> Mat {
    let determinant = determinant_mat(moment);
    if determinant > SMALLEST_DETERMINANT {
        return adjugate(moment) * (1.0 / determinant);
    }
    return mat_identity();
}
