// Inverse of a moment matrix, or the unit tensor where too few neighbours are left to define one.
// Twin: safe_inverse in src/pair.rs
#import tensor

// A corner particle of a cube keeps an eighth of its moment; below this the correction amplifies noise.
const SMALLEST_DETERMINANT: real = 0.02;

fn safe_inverse(moment: Mat) -> Mat {
    let determinant = determinant_mat(moment);
    if determinant > SMALLEST_DETERMINANT {
        return adjugate(moment) * (1.0 / determinant);
    }
    return mat_identity();
}
