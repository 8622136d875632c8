//! By how much a deformation raises the largest stiffness against plane waves, d^2 psi/d lambda_i^2 over its value when
//! unstressed, rho_0 c^2: the square of the highest frequency rises by no more. Twin: shaders/lib/stiffness.wgsl
//!
//! With principal stretches lambda_i and Kirchhoff stresses tau_i the stiffness is (d tau_i/d ln lambda_i - tau_i)/lambda_i^2,
//! largest across the shortest stretch. Of the law itself it needs the mean stress at two volumes alone, so that a new
//! pressure is bounded as soon as it is written.

use super::strain::{isochoric_change, lacking, right_strain, volume_change};
use crate::rows::Body;
use crate::tensor::{Real, Space};

/// Part of the volume over which the mean stress is differenced. Towards compression, where laws stiffen, so that the
/// difference is not below the derivative.
const PART: f64 = 0.01;

/// The volume J - 1 from which, to a second one J - 1, the mean stress is differenced.
#[inline(always)]
pub(super) fn denser<R: Real>(change: R) -> R {
    change - R::of(PART) * (R::of(1.0) + change)
}

/// The smallest eigenvalue of C - 1.
#[inline(always)]
pub fn least_strain<S: Space>(h: S::Mat) -> S::Real {
    let strain = S::mat_of_sym(right_strain::<S>(h));
    let (zero, trace) = (S::Real::of(0.0), S::trace(strain));
    match S::DIMENSION {
        1 => trace,
        2 => {
            let half = S::Real::of(0.5) * trace;
            half - (half * half - S::determinant(strain)).max(zero).sqrt()
        }
        _ => least_root(trace, S::trace(S::adjugate(strain)), S::determinant(strain)),
    }
}

/// The smallest root of x^3 - t x^2 + s x - q, which has three, all above -1. Laguerre's iteration from below never passes a
/// root, and meets one of any multiplicity at once.
#[inline(always)]
fn least_root<R: Real>(t: R, s: R, q: R) -> R {
    let (zero, two, three) = (R::of(0.0), R::of(2.0), R::of(3.0));
    let mut x = R::of(-1.0);
    for _ in 0..6 {
        let value = ((x - t) * x + s) * x - q;
        if value >= zero {
            break;
        }
        let (slope, bend) = ((three * x - two * t) * x + s, two * (three * x - t));
        let first = slope / value;
        let second = first * first - bend / value;
        let rate = first - (two * (three * second - first * first)).max(zero).sqrt();
        // At a root of several to rounding nothing is left to go by; no root that is the smallest is above their mean.
        if rate >= zero {
            break;
        }
        x = (x - three / rate).min(t * R::of(1.0 / 3.0));
    }
    x
}

/// Of a law made of a mean stress, here at J - 1 and at [`denser`] of it, and a neo-Hookean deviator, which a yield stress
/// bounds.
#[inline(always)]
pub(super) fn by_volume<S: Space>(body: &Body<S::Real>, h: S::Mat, mean: S::Real, at_denser: S::Real) -> S::Real {
    let real = S::Real::of;
    let least = real(1.0) + least_strain::<S>(h);
    let volumetric = ((mean - at_denser) * real(1.0 / PART) - mean) / body.bulk_modulus;
    let trace = real(3.0) + S::sym_trace(right_strain::<S>(h));
    let elastic = (real(1.0) + isochoric_change(volume_change::<S>(h))) * (real(5.0 / 12.0) * trace - real(0.25) * least);
    let deviatoric = if body.shear_modulus <= real(0.0) {
        real(0.0)
    } else if body.yield_stress > real(0.0) {
        elastic.min(real(1.0) + real(0.75) * body.yield_stress / body.shear_modulus)
    } else {
        elastic
    };
    // A motion may be of either kind alone, so that the larger bounds their sum.
    volumetric.max(deviatoric) / least
}

/// Of a stress linear in Green's strain, which stiffens when stretched: at most lambda^2 + (lambda^2 - 1)/2 of the longest
/// stretch.
#[inline(always)]
pub(super) fn by_stretch<S: Space>(h: S::Mat) -> S::Real {
    let others = (S::Real::of(2.0) - lacking::<S>()) * least_strain::<S>(h);
    S::Real::of(1.0) + S::Real::of(1.5) * (S::sym_trace(right_strain::<S>(h)) - others)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::{Line, Plane, Solid};

    fn diagonal<S: Space>(strains: [f64; 3]) -> S::Mat {
        let mut h = S::Mat::default();
        for k in 0..S::DIMENSION {
            h[S::mat_index(k, k)] = S::Real::of(strains[k]);
        }
        h
    }

    #[test]
    fn the_least_strain_is_the_smallest_eigenvalue() {
        for stretches in [[0.3, 0.3, 0.3], [-0.4, 0.1, 0.7], [0.0, 0.0, 0.0], [2.0, -0.1, -0.1], [-0.6, -0.6, 1.0]] {
            let square = |k: usize| (1.0 + stretches[k]) * (1.0f64 + stretches[k]) - 1.0;
            let least = |n: usize| (0..n).map(square).fold(f64::INFINITY, f64::min);
            assert!((least_strain::<Line<f64>>(diagonal::<Line<f64>>(stretches)) - least(1)).abs() < 1e-12);
            assert!((least_strain::<Plane<f64>>(diagonal::<Plane<f64>>(stretches)) - least(2)).abs() < 1e-7);
            let found = least_strain::<Solid<f64>>(diagonal::<Solid<f64>>(stretches));
            assert!((found - least(3)).abs() < 2e-3 && found < least(3) + 1e-6, "{stretches:?}: {found} for {}", least(3));
        }
    }
}
