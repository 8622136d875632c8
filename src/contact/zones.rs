//! Fuller's contact of particles with surfaces (2010, 4.3). Twin: shaders/contact/zones.wgsl
//!
//! A particle with 75 % or less of the most neighbours lies on the surface, one with 50 % or less is a corner: see
//! `find_surface`. Its normal is sum W_ab (x_a - x_b)/r_ab, made a unit vector (4.1), over all neighbours, over those
//! inside alone, or as it was at the start: see `find_normals`. About each surface particle, the owner, lies a square
//! zone of half side R along the normal and the tangent; in space a cylinder. A particle of another body inside, the
//! intruder, is pushed along the owner's normal, and the owner the other way, by (4.2):
//!
//! - printed: -(R/r + 1) on the owner: a jump by 2 where the intruder enters or leaves;
//! - mended: R/r - 1 on the intruder: zero at first touch,
//!
//! r the distance along the normal. A corner takes the normals of all surface particles in the kernel's range beside
//! its own, and acts inside all of their zones only. Friction (4.3) is mu times this force against the tangential
//! velocity.
//!
//! Kept: linear momentum, to rounding. Not kept: energy, since the force on a pair depends on who owns whom, on normals
//! that turn with other particles, and ends with a jump at the zone's sides: slow bodies leave faster than they came;
//! angular momentum, since the force does not point from one to the other: a pair d apart loses d x f. `tests/contact`
//! asserts both.

use crate::tensor::Real;
use serde::Deserialize;

/// Which (4.2) pushes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    Printed,
    #[default]
    Mended,
}

/// Which neighbours the normals are made of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Normals {
    All,
    /// Those that do not lie on the surface themselves.
    #[default]
    WithoutSurface,
    /// The same, found at the start and never again: wrong as soon as a body turns.
    Initial,
}

/// What decides the passes and their text.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Options {
    pub form: Form,
    pub normals: Normals,
    pub friction: bool,
}

/// What a particle is to its surface, as `find_surface` numbers it. Twin: `shaders/contact/zones.wgsl`
pub const SURFACE: u32 = 1;
pub const CORNER: u32 = 2;

/// Of the half side: keeps the force finite where the intruder crosses the owner's plane.
const LEAST_DISTANCE: f64 = 1e-6;

/// Size of the force on the intruder at r/R < 1 along the normal.
#[inline(always)]
pub fn penalty<R: Real>(form: Form, q: R) -> R {
    let inverse = R::of(1.0) / q.max(R::of(LEAST_DISTANCE));
    match form {
        Form::Printed => inverse + R::of(1.0),
        Form::Mended => inverse - R::of(1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_force_jumps_by_two_where_the_mended_one_starts_from_zero() {
        let at = |form| penalty(form, 1.0f64);
        assert_eq!((at(Form::Printed), at(Form::Mended)), (2.0, 0.0));
        assert!(penalty(Form::Mended, 0.0f64).is_finite() && penalty(Form::Mended, 0.5f64) == 1.0);
    }
}
