// Inverse of a moment matrix, or the unit tensor where too few neighbours are left to define one.
// Twin: safe_inverse in src/pair.rs
#import tensor

// A corner particle of a cube keeps an eighth of its moment; below this the correction amplifies noise.
const SMALLEST_DETERMINANT: real = 0.02;

// Inverse of a moment matrix of the reference configuration, or the unit tensor where the neighbours lie in a plane
// or on a line. Its numbers may be small, an eighth at the corner of a cube, as long as they are alike.
fn reference_inverse(moment: Mat) -> Mat {
    let determinant = determinant_mat(moment);
    let mean = trace(moment) * (1.0 / real(DIMENSION));
    var isotropic: real = 1.0;
    for (var k = 0u; k < DIMENSION; k++) {
        isotropic *= mean;
    }
    if determinant > 1e-3 * isotropic {
        return adjugate(moment) * (1.0 / determinant);
    }
    return mat_identity();
}

fn safe_inverse(moment: Mat) -> Mat {
    let determinant = determinant_mat(moment);
    if determinant > SMALLEST_DETERMINANT {
        return adjugate(moment) * (1.0 / determinant);
    }
    return mat_identity();
}
