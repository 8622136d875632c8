//! Eigenvalues and eigenvectors of matrices of up to three rows, for the stability analyses.

use glam::{DMat3, DVec2, DVec3};

/// One eigenvalue and eigenvector. A complex pair appears as two entries, each the conjugate of the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eigenpair {
    /// Real and imaginary part of the eigenvalue.
    pub value: [f64; 2],
    /// Real part of the eigenvector; real and imaginary part together have length one.
    pub vector: DVec3,
    /// Imaginary part of the eigenvector, zero where the eigenvalue is real.
    pub imaginary: DVec3,
}

impl Eigenpair {
    fn new(value: [f64; 2], vector: DVec3, imaginary: DVec3) -> Self {
        let length = (vector.length_squared() + imaginary.length_squared()).sqrt();
        Self { value, vector: vector / length, imaginary: imaginary / length }
    }
    /// Principal square root of the eigenvalue: real part (never negative) and imaginary part.
    pub fn square_root(&self) -> [f64; 2] {
        let [re, im] = self.value;
        let length = re.hypot(im);
        // The smaller part from the larger, or it is lost in the difference.
        if re >= 0.0 {
            let root = (0.5 * (length + re)).sqrt();
            [root, if root > 0.0 { 0.5 * im / root } else { 0.0 }]
        } else {
            let root = (0.5 * (length - re)).sqrt();
            [0.5 * im.abs() / root, root.copysign(im)]
        }
    }
}

/// Eigenpairs of the leading `dimension` rows and columns of any real matrix.
///
/// In three dimensions the eigenvalue farthest from the mean of all is split off first: it is always simple,
/// so that an equal pair (a transverse wave along an axis) keeps full precision in the remaining block.
pub fn eigenpairs(matrix: DMat3, dimension: usize) -> Vec<Eigenpair> {
    let entry = |row: usize, column: usize| matrix.col(column)[row];
    match dimension {
        1 => vec![Eigenpair::new([entry(0, 0), 0.0], DVec3::X, DVec3::ZERO)],
        2 => block([entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)])
            .map(|(value, re, im)| Eigenpair::new(value, re.extend(0.0), im.extend(0.0)))
            .to_vec(),
        _ => solid(matrix),
    }
}

/// Eigenvalue with real and imaginary part of its eigenvector, twice, for the matrix [[a, b], [c, d]].
fn block([a, b, c, d]: [f64; 4]) -> [([f64; 2], DVec2, DVec2); 2] {
    let (mean, half) = (0.5 * (a + d), 0.5 * (a - d));
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let root = (-discriminant).sqrt();
        return [root, -root].map(|im| ([mean, im], DVec2::new(b, -half), DVec2::new(0.0, im)));
    }
    let root = discriminant.sqrt();
    let vector = |shift: f64, other: DVec2| {
        let rows = [DVec2::new(half - shift, b), DVec2::new(c, -half - shift)];
        let row = if rows[0].length_squared() > rows[1].length_squared() { rows[0] } else { rows[1] };
        row.perp().try_normalize().unwrap_or(other)
    };
    [([mean + root, 0.0], vector(root, DVec2::X), DVec2::ZERO), ([mean - root, 0.0], vector(-root, DVec2::Y), DVec2::ZERO)]
}

fn solid(matrix: DMat3) -> Vec<Eigenpair> {
    let mean = (matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z) / 3.0;
    let deviation = matrix - DMat3::from_diagonal(DVec3::splat(mean));
    let scale = deviation.to_cols_array().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    if scale <= 1e-14 * mean.abs() {
        return DVec3::AXES.map(|axis| Eigenpair::new([mean, 0.0], axis, DVec3::ZERO)).to_vec();
    }
    let scaled = deviation * (1.0 / scale);
    let first = isolated_root(scaled);
    let vector = null_vector(scaled - DMat3::from_diagonal(DVec3::splat(first)));
    let (u, w) = vector.any_orthonormal_pair();
    let (image_u, image_w) = (scaled * u, scaled * w);
    let coupling = DVec2::new(vector.dot(image_u), vector.dot(image_w));
    let mut pairs = vec![Eigenpair::new([mean + scale * first, 0.0], vector, DVec3::ZERO)];
    for (value, re, im) in block([u.dot(image_u), u.dot(image_w), w.dot(image_u), w.dot(image_w)]) {
        // The component along the first eigenvector that the triangular form asks for: coupling / (value - first).
        let (gap, product) = (DVec2::new(value[0] - first, value[1]), DVec2::new(coupling.dot(re), coupling.dot(im)));
        let along = DVec2::new(product.dot(gap), product.y * gap.x - product.x * gap.y) / gap.length_squared();
        let vector_re = u * re.x + w * re.y + vector * along.x;
        let vector_im = u * im.x + w * im.y + vector * along.y;
        pairs.push(Eigenpair::new([mean + scale * value[0], scale * value[1]], vector_re, vector_im));
    }
    pairs
}

/// The real root of largest modulus of x^3 + p x + q, the characteristic polynomial of a traceless matrix.
fn isolated_root(matrix: DMat3) -> f64 {
    let square = matrix * matrix;
    let p = -0.5 * (square.x_axis.x + square.y_axis.y + square.z_axis.z);
    let q = -matrix.determinant();
    let discriminant = 0.25 * q * q + p * p * p / 27.0;
    let size = if discriminant < 0.0 {
        let radius = (-p / 3.0).sqrt();
        2.0 * radius * ((0.5 * q.abs() / radius.powi(3)).min(1.0).acos() / 3.0).cos()
    } else {
        let u = (0.5 * q.abs() + discriminant.sqrt()).cbrt();
        if u > 0.0 { u - p / (3.0 * u) } else { 0.0 }
    };
    let mut root = -size.copysign(q);
    for _ in 0..2 {
        let slope = 3.0 * root * root + p;
        if slope != 0.0 {
            root -= (root * root * root + p * root + q) / slope;
        }
    }
    root
}

/// Unit vector that a matrix of rank two maps to zero.
fn null_vector(matrix: DMat3) -> DVec3 {
    let rows = matrix.transpose();
    [rows.x_axis.cross(rows.y_axis), rows.y_axis.cross(rows.z_axis), rows.z_axis.cross(rows.x_axis)]
        .into_iter()
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        .and_then(DVec3::try_normalize)
        .unwrap_or(DVec3::X)
}

/// Principal values and, as columns, principal axes of a symmetric matrix (Jacobi's rotations).
pub fn principal(matrix: DMat3) -> (DVec3, DMat3) {
    let (mut a, mut axes) = (matrix, DMat3::IDENTITY);
    for _sweep in 0..20 {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let off = a.col(j)[i];
            if off == 0.0 {
                continue;
            }
            let angle = 0.5 * (2.0 * off).atan2(a.col(j)[j] - a.col(i)[i]);
            let (sin, cos) = angle.sin_cos();
            let mut rotation = DMat3::IDENTITY;
            rotation.col_mut(i)[i] = cos;
            rotation.col_mut(j)[j] = cos;
            rotation.col_mut(j)[i] = sin;
            rotation.col_mut(i)[j] = -sin;
            a = rotation.transpose() * a * rotation;
            a.col_mut(i)[j] = 0.0;
            a.col_mut(j)[i] = 0.0;
            axes *= rotation;
        }
    }
    (DVec3::new(a.x_axis.x, a.y_axis.y, a.z_axis.z), axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn residual(matrix: DMat3, pair: &Eigenpair) -> f64 {
        let [re, im] = pair.value;
        let real = matrix * pair.vector - pair.vector * re + pair.imaginary * im;
        let imaginary = matrix * pair.imaginary - pair.imaginary * re - pair.vector * im;
        real.length() + imaginary.length()
    }

    fn check(matrix: DMat3) {
        let scale = matrix.to_cols_array().iter().map(|x| x.abs()).sum::<f64>() + f64::MIN_POSITIVE;
        let pairs = eigenpairs(matrix, 3);
        let trace: f64 = pairs.iter().map(|pair| pair.value[0]).sum();
        assert!((trace - matrix.x_axis.x - matrix.y_axis.y - matrix.z_axis.z).abs() <= 1e-12 * scale);
        for pair in &pairs {
            assert!(residual(matrix, pair) < 1e-11 * scale, "{matrix:?} {pair:?}");
            let [re, im] = pair.square_root();
            let error = (re * re - im * im - pair.value[0]).abs() + (2.0 * re * im - pair.value[1]).abs();
            assert!(re >= 0.0 && error <= 1e-13 * scale);
        }
    }

    #[test]
    fn eigenpairs_solve_their_equation() {
        let mut seed = 1u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for _ in 0..2000 {
            let general = DMat3::from_cols_array(&std::array::from_fn(|_| random()));
            let symmetric = general + general.transpose();
            check(general);
            check(symmetric);
            // An equal pair, in no special direction.
            let axis = DVec3::new(random(), random(), random()).normalize();
            let columns = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
            check(columns * random() - DMat3::IDENTITY);
            let (values, axes) = principal(symmetric);
            assert!((axes * DMat3::from_diagonal(values) * axes.transpose()).abs_diff_eq(symmetric, 1e-13));
        }
        check(DMat3::IDENTITY * -3.0);
        check(DMat3::ZERO);
        check(DMat3::from_rotation_z(0.3));
        check(DMat3::from_diagonal(DVec3::new(-1.0, -1.0, 0.0)));
    }

    #[test]
    fn equal_pairs_stay_real_to_round_off() {
        let axis = DVec3::new(0.6, 0.0, 0.8);
        let matrix = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z) * 0.7 - DMat3::IDENTITY;
        for pair in eigenpairs(matrix, 3) {
            assert!(pair.square_root()[0] < 1e-15, "{pair:?}");
        }
    }
}
