//! Contact of surfaces through their facets: points of a body's exact surface with a normal and an area, each
//! carried by the particle beneath it, x = x_p + F_p (X - X_p). Twin: shaders/lib/facet.wgsl
//!
//! The distance of facet e from another surface is the mean over that surface's facets f, seen along their normals,
//!
//! g_e = sum_f w_ef n_f.(x_e - x_f) / D_e, D_e = sum_f w_ef, w_ef = (1 - r^2/R^2)^3 (n_e.n_f)^2,
//!
//! over facets within R that face e. On a flat face all terms are equal, so that g is exact, and the face is
//! slippery, whatever the lattice beneath it. The energy is (k/2) A_e g^2 s(D_e/D_0) where g < 0; s falls smoothly
//! from 1 to 0 past the edge of a surface, where few facets are left. Each surface measures the other. The forces
//! are the exact derivatives, by x and, through the normals n = F^-T N/|F^-T N|, by F: they keep energy, momentum
//! and angular momentum.
//!
//! The form `along_normals` leaves out all but the force along the normals, spread over f by w/D: this is the
//! smoothed normal gap as it is commonly used. It keeps momentum only.

use crate::state::State;
use crate::tensor::{Real, Space};

/// Part of the sum of weights on a flat face below which the energy fades.
const FULL: f64 = 0.3;

/// D_0 of facets one spacing apart: the continuous sum on a flat face, in part. `range` is in spacings.
pub fn full_weight(range: f64, dimension: usize) -> f64 {
    let flat = match dimension {
        1 => 1.0,
        2 => 32.0 / 35.0 * range,
        _ => std::f64::consts::PI * range * range / 4.0,
    };
    FULL * flat.max(1.0)
}

/// How two facets face each other: x_e - x_f, the weight, and its derivatives by x (times x) and by n_e.n_f. All but the
/// first are zero out of range, and where the two look the same way.
pub struct Facing<S: Space> {
    pub x: S::Vec,
    pub weight: S::Real,
    pub by_distance: S::Real,
    pub by_turn: S::Real,
}

/// The code has no branch: a third of a list is out of range, in no order that a processor could predict.
#[inline(always)]
pub fn facing<S: Space>(state: &State<S>, e: usize, f: usize, range: S::Real) -> Facing<S> {
    let (columns, zero, one) = (&state.columns, S::Real::of(0.0), S::Real::of(1.0));
    let x = facet_separation(state, e, f);
    let left = (one - S::inner(x, x) / (range * range)).max(zero);
    let turn = S::inner(columns.facet_normal[e], columns.facet_normal[f]).min(zero);
    let (square, cube, toward) = (left * left, left * left * left, turn * turn);
    Facing {
        x,
        weight: cube * toward,
        by_distance: S::Real::of(-6.0) * square * toward / (range * range),
        by_turn: S::Real::of(2.0) * cube * turn,
    }
}

/// x_e - x_f
#[inline(always)]
pub fn facet_separation<S: Space>(state: &State<S>, e: usize, f: usize) -> S::Vec {
    let columns = &state.columns;
    (columns.facet_reference_position[e] - columns.facet_reference_position[f])
        + (columns.facet_displacement[e] - columns.facet_displacement[f])
}

/// Separation of facet e from its particle in the reference configuration.
#[inline(always)]
pub fn lever<S: Space>(state: &State<S>, e: usize) -> S::Vec {
    let columns = &state.columns;
    columns.facet_reference_position[e] - columns.reference_position[columns.facet_owner[e] as usize]
}

/// s = 3 t^2 - 2 t^3 up to t = 1, and its derivative by t.
#[inline(always)]
pub fn fade<R: Real>(t: R) -> (R, R) {
    let (one, two, three) = (R::of(1.0), R::of(2.0), R::of(3.0));
    if t >= one {
        return (one, R::of(0.0));
    }
    (t * t * (three - two * t), R::of(6.0) * t * (one - t))
}

/// Coulomb friction with an elastic slip, which was `before` and would be `slip`. The traction is `stiffness` times the slip and
/// at most `limit`: returns the slip cut down to that, and the heat. That is the work of the mean of the tractions before and
/// after, as the bodies lose it in a step, less what the spring stores; the elastic energy of the slip that was cut would be
/// more, the longer the step.
#[inline(always)]
pub fn stick<S: Space>(before: S::Vec, slip: S::Vec, stiffness: S::Real, limit: S::Real) -> (S::Vec, S::Real) {
    let length = S::inner(slip, slip).sqrt();
    let most = limit / stiffness;
    if length <= most {
        return (slip, S::Real::of(0.0));
    }
    let left = slip * (most / length);
    (left, S::Real::of(0.5) * stiffness * S::inner(before + left, slip - left))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::{Plane, Tuple};

    #[test]
    fn fading_is_smooth() {
        for k in 1..40 {
            let (t, step) = (k as f64 * 0.03, 1e-7);
            let difference = (fade(t + step).0 - fade(t - step).0) / (2.0 * step);
            assert!((fade(t).1 - difference).abs() < 1e-6, "at {t}");
        }
        assert_eq!((fade(0.0).0, fade(1.0).0), (0.0, 1.0));
    }

    #[test]
    fn slip_beyond_the_limit_turns_into_heat() {
        let slip = Tuple([3.0, 4.0]);
        // Steady slip over a distance of 3 against the limit.
        let (left, heat) = stick::<Plane<f64>>(Tuple([1.2, 1.6]), slip, 2.0, 4.0);
        let errors = [left[0] - 1.2, left[1] - 1.6, heat - 12.0];
        assert!(errors.iter().all(|error| error.abs() < 1e-14), "{left:?} {heat}");
        // From rest the mean traction is half the limit, and the spring takes its part.
        let (_, heat) = stick::<Plane<f64>>(Tuple([0.0, 0.0]), slip, 2.0, 4.0);
        assert!((heat - (0.5 * 4.0 * 5.0 - 0.25 * 4.0 * 4.0)).abs() < 1e-14, "{heat}");
        assert_eq!(stick::<Plane<f64>>(Tuple([0.0, 0.0]), slip, 2.0, 11.0), (slip, 0.0));
    }
}
