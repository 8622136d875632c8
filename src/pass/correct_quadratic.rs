//! Coefficients of the gradient that is exact for quadratic displacements.
//!
//! With the separations d = X_b - X_a, p = (d, d d) and the weights w = -V_b W'(R)/R, the least-squares fit of
//! u_b - u_a by H d + A : d d has (H, A) = [sum w (u_b - u_a) (x) p] M^-1, M = sum w p (x) p. The columns of M^-1
//! that belong to H are the coefficients: H = [sum w (u_b - u_a) (x) d] C1 + [sum w (u_b - u_a) (x) d d] C2.
//!
//! Twin: shaders/pass/correct_quadratic.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use crate::bond::{Source, with_bonds};
use crate::state::State;
use crate::tensor::{Linear, Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "coefficients of the gradient that is exact for quadratic displacements",
        entries: LISTED,
        runs: Runs::Always,
        own: &[always(&[ReferencePosition, ReferenceCorrection, NeighborCount, Neighbors]), when(|m| m.many_bodies, &[Body])],
        neighbours: &[always(&[ReferencePosition, ReferenceVolume]), when(|m| m.tied, &[Body])],
        writes: &[always(&[LinearCoefficient, QuadraticCoefficient])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let mut coefficients = vec![(S::Sym::default(), S::Tri::default()); state.params.count as usize];
    with_bonds!(state, B => super::write(&mut coefficients, |a, slot| *slot = coefficients_of::<S, B>(state, a)));
    let columns = &mut state.columns;
    for (a, (linear, quadratic)) in coefficients.into_iter().enumerate() {
        (columns.linear_coefficient[a], columns.quadratic_coefficient[a]) = (linear, quadratic);
    }
}

/// Number of components of p.
fn terms<S: Space>() -> usize {
    S::DIMENSION + S::Sym::LENGTH
}

/// Where too few neighbours define the quadratic part, the linear fit.
fn coefficients_of<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> (S::Sym, S::Tri) {
    let h = state.smoothing_length(a);
    let inverse = inverted::<S>(moment::<S, B>(state, a, h));
    let Some(inverse) = inverse else { return (state.columns.reference_correction[a], S::Tri::default()) };
    let (one, n) = (S::Real::of(1.0), terms::<S>());
    let (square, cube) = (one / (h * h), one / (h * h * h));
    let (mut linear, mut quadratic) = (S::Sym::default(), S::Tri::default());
    for j in 0..S::DIMENSION {
        for i in 0..=j {
            linear[S::sym_index(i, j)] = inverse[i * n + j] * square;
        }
        for s in 0..S::Sym::LENGTH {
            quadratic[j * S::Sym::LENGTH + s] = inverse[(S::DIMENSION + s) * n + j] * cube;
        }
    }
    (linear, quadratic)
}

/// M with lengths in units of h, so that its numbers are alike.
fn moment<S: Space, B: Source<S>>(state: &State<S>, a: usize, h: S::Real) -> S::Quadratic {
    let n = terms::<S>();
    let mut moment = S::Quadratic::default();
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            let d = bond.row.x * (S::Real::of(-1.0) / h);
            let products = S::products(d);
            let p = |k: usize| if k < S::DIMENSION { d[k] } else { products[k - S::DIMENSION] };
            for row in 0..n {
                for column in 0..n {
                    moment[row * n + column] -= bond.row.weight * p(row) * p(column);
                }
            }
        }
    }
    moment
}

/// Where a pivot is smaller than this fraction of the largest, the neighbours do not define the quadratic fit.
const SMALLEST_PIVOT: f64 = 1e-3;

/// Gauss-Jordan without exchange of rows: the matrix is symmetric and positive.
fn inverted<S: Space>(mut m: S::Quadratic) -> Option<S::Quadratic> {
    let n = terms::<S>();
    let one = S::Real::of(1.0);
    let largest = (0..n).fold(S::Real::of(0.0), |largest, k| largest.max(m[k * n + k]));
    for k in 0..n {
        let pivot = m[k * n + k];
        if pivot <= largest * S::Real::of(SMALLEST_PIVOT) {
            return None;
        }
        m[k * n + k] = one;
        for column in 0..n {
            m[k * n + column] = m[k * n + column] * (one / pivot);
        }
        for row in (0..n).filter(|&row| row != k) {
            let factor = m[row * n + k];
            m[row * n + k] = S::Real::of(0.0);
            for column in 0..n {
                let part = factor * m[k * n + column];
                m[row * n + column] -= part;
            }
        }
    }
    Some(m)
}
