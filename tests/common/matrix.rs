//! Matrices of space as plain rows, for answers that share nothing with the crate's own tensors.

pub type M = [[f64; 3]; 3];

pub fn times(a: &M, b: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

pub fn transposed(a: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

/// A + w B
pub fn plus(a: &M, w: f64, b: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + w * b[i][j]))
}

pub fn scaled(a: &M, w: f64) -> M {
    a.map(|row| row.map(|x| x * w))
}

pub fn deviator(a: &M) -> M {
    let third = (a[0][0] + a[1][1] + a[2][2]) / 3.0;
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] - if i == j { third } else { 0.0 }))
}

pub fn inner(a: &M, b: &M) -> f64 {
    (0..9).map(|k| a[k / 3][k % 3] * b[k / 3][k % 3]).sum()
}

pub fn determinant(a: &M) -> f64 {
    (0..3).map(|k| a[0][k] * (a[1][(k + 1) % 3] * a[2][(k + 2) % 3] - a[1][(k + 2) % 3] * a[2][(k + 1) % 3])).sum()
}

pub fn inverse(a: &M) -> M {
    let cofactor = |i: usize, j: usize| {
        let at = |r: usize, c: usize| a[(i + r) % 3][(j + c) % 3];
        at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
    };
    let d = determinant(a);
    std::array::from_fn(|i| std::array::from_fn(|j| cofactor(j, i) / d))
}
