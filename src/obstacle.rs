//! Rigid bodies of exact shape that deformable ones touch: signed distance and outward normal at a point.
//! Twin: shaders/lib/obstacle.wgsl
//!
//! A point is given relative to the obstacle's own point, where it touches first: a point of a plane, the apex of a
//! cone or pyramid, a point on the surface of a ball or cylinder (its centre would cost the digits of the radius: the
//! gap would be wrong by EPSILON radius, where from the surface it is wrong by EPSILON times the distance of the point
//! from there). `axis` leads from that point into the obstacle, but away from a plane.

use crate::rows::Obstacle;
use crate::tensor::{Real, Space};
use glam::DVec3;
use serde::Deserialize;

macro_rules! kinds {
    ($($(#[$attribute:meta])* $word:ident: $name:ident, $about:literal;)*) => {
        /// Names the shapes. Their numbers are those of the shader.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
        #[serde(rename_all = "snake_case")]
        #[repr(u32)]
        pub enum ObstacleKind { $($(#[$attribute])* $name),* }

        impl ObstacleKind {
            pub const ALL: &'static [ObstacleKind] = &[$(ObstacleKind::$name),*];
            /// Word in a scene.
            pub fn name(self) -> &'static str {
                match self { $(ObstacleKind::$name => stringify!($word)),* }
            }
            pub fn about(self) -> &'static str {
                match self { $(ObstacleKind::$name => $about),* }
            }
        }
    };
}

kinds! {
    plane: Plane, "the half space behind a plane";
    #[serde(alias = "disc")]
    sphere: Sphere, "a ball, in 2D a disc";
    cylinder: Cylinder, "an endless round bar across the axis";
    #[serde(alias = "wedge")]
    cone: Cone, "a cone of any half angle, in 2D a wedge";
    berkovich: Berkovich, "a pyramid of three faces at the same angle to the axis: 3D only";
}

impl ObstacleKind {
    /// Whether a scene of this dimension can have one.
    pub fn fits(self, dimension: usize) -> bool {
        match self {
            ObstacleKind::Plane | ObstacleKind::Sphere => true,
            ObstacleKind::Cylinder | ObstacleKind::Cone => dimension > 1,
            ObstacleKind::Berkovich => dimension == 3,
        }
    }
}

/// Angle (degrees) between a face of Berkovich's pyramid and its axis, at which it has the cross-section 24.5 h^2 of
/// Vickers' pyramid: Oliver & Pharr, J. Mater. Res. 7 (1992) 1564. The 24.56 h^2 in use elsewhere are those of 65.3.
pub const BERKOVICH: f64 = 65.27;

impl Obstacle<f64> {
    /// `axis` and `turn` have any length; what `turn` has along the axis is taken off, and where nothing is left any
    /// direction across the axis serves. `half_angle` in degrees.
    pub fn new(kind: ObstacleKind, point: DVec3, [axis, turn]: [DVec3; 2], radius: f64, half_angle: f64) -> Self {
        let axis = axis.normalize();
        let turn = turn.reject_from_normalized(axis).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
        let (sine, cosine) = half_angle.to_radians().sin_cos();
        let ([point_x, point_y, point_z], [axis_x, axis_y, axis_z]) = (point.to_array(), axis.to_array());
        let [turn_x, turn_y, turn_z] = turn.to_array();
        let (kind, padding) = (kind as u32, 0);
        Self { kind, padding, point_x, point_y, point_z, axis_x, axis_y, axis_z, turn_x, turn_y, turn_z, radius, cosine, sine }
    }

    /// In another precision.
    pub fn cast<R: Real>(&self) -> Obstacle<R> {
        Obstacle {
            kind: self.kind,
            padding: self.padding,
            point_x: R::of(self.point_x),
            point_y: R::of(self.point_y),
            point_z: R::of(self.point_z),
            axis_x: R::of(self.axis_x),
            axis_y: R::of(self.axis_y),
            axis_z: R::of(self.axis_z),
            turn_x: R::of(self.turn_x),
            turn_y: R::of(self.turn_y),
            turn_z: R::of(self.turn_z),
            radius: R::of(self.radius),
            cosine: R::of(self.cosine),
            sine: R::of(self.sine),
        }
    }
}

/// Signed distance (m) of `x`, a place relative to the obstacle's point, from the surface, negative inside, and the
/// outward normal there, the distance's gradient.
///
/// Exact, but for a pyramid seen from over its edges or apex, where it is that of the face's plane, less than the true
/// distance. Where several points of the surface are nearest (in the middle of a ball, on the axis of a cone or
/// pyramid) the normal leads along the axis out of the obstacle, which is what symmetry asks for at an apex.
#[inline(always)]
pub fn distance<S: Space>(obstacle: &Obstacle<S::Real>, x: S::Vec) -> (S::Real, S::Vec) {
    let axis = vector::<S>([obstacle.axis_x, obstacle.axis_y, obstacle.axis_z]);
    let turn = vector::<S>([obstacle.turn_x, obstacle.turn_y, obstacle.turn_z]);
    match ObstacleKind::ALL[obstacle.kind as usize] {
        ObstacleKind::Plane => (S::inner(x, axis), axis),
        ObstacleKind::Sphere => ball::<S>(x, axis, obstacle.radius),
        ObstacleKind::Cylinder => ball::<S>(x - turn * S::inner(x, turn), axis, obstacle.radius),
        ObstacleKind::Cone => cone::<S>(obstacle, x, axis),
        ObstacleKind::Berkovich => pyramid::<S>(obstacle, x, [axis, turn]),
    }
}

fn vector<S: Space>(components: [S::Real; 3]) -> S::Vec {
    let mut v = S::Vec::default();
    for k in 0..S::DIMENSION {
        v[k] = components[k];
    }
    v
}

/// |x - R a| - R, without the digits of R: (x.x - 2R x.a)/(|x - R a| + R).
fn ball<S: Space>(x: S::Vec, axis: S::Vec, radius: S::Real) -> (S::Real, S::Vec) {
    let from_center = x - axis * radius;
    let away = S::inner(from_center, from_center).sqrt();
    let gap = S::inner(x, x - axis * (radius + radius)) / (away + radius);
    (gap, direction::<S>(from_center, away, axis))
}

/// A vector over its length, or against the axis where it has none.
fn direction<S: Space>(v: S::Vec, length: S::Real, axis: S::Vec) -> S::Vec {
    if length > S::Real::of(0.0) { v * (S::Real::of(1.0) / length) } else { axis * S::Real::of(-1.0) }
}

fn cone<S: Space>(obstacle: &Obstacle<S::Real>, x: S::Vec, axis: S::Vec) -> (S::Real, S::Vec) {
    let (cosine, sine) = (obstacle.cosine, obstacle.sine);
    let height = S::inner(x, axis);
    let across = x - axis * height;
    let radius = S::inner(across, across).sqrt();
    let gap = radius * cosine - height * sine;
    if radius * sine + height * cosine < S::Real::of(0.0) {
        // Nothing is nearer than the apex.
        let away = S::inner(x, x).sqrt();
        return (away, direction::<S>(x, away, axis));
    }
    if radius > S::Real::of(0.0) {
        return (gap, across * (cosine / radius) - axis * sine);
    }
    (gap, axis * S::Real::of(-1.0))
}

fn pyramid<S: Space>(obstacle: &Obstacle<S::Real>, x: S::Vec, [axis, turn]: [S::Vec; 2]) -> (S::Real, S::Vec) {
    let (half, across) = (S::Real::of(-0.5), S::Real::of(0.75_f64.sqrt()));
    let third = vector::<S>([
        obstacle.axis_y * obstacle.turn_z - obstacle.axis_z * obstacle.turn_y,
        obstacle.axis_z * obstacle.turn_x - obstacle.axis_x * obstacle.turn_z,
        obstacle.axis_x * obstacle.turn_y - obstacle.axis_y * obstacle.turn_x,
    ]);
    // Directions across the axis in which the faces look; their sum is zero, so the furthest along is never negative.
    let mut faces = [turn, turn * half + third * across, turn * half - third * across].into_iter();
    let mut face = faces.next().unwrap_or(turn);
    let mut reach = S::inner(x, face);
    for other in faces {
        let further = S::inner(x, other);
        if further > reach {
            (face, reach) = (other, further);
        }
    }
    let gap = reach * obstacle.cosine - S::inner(x, axis) * obstacle.sine;
    if reach > S::Real::of(0.0) {
        return (gap, face * obstacle.cosine - axis * obstacle.sine);
    }
    (gap, axis * S::Real::of(-1.0))
}

#[cfg(test)]
mod tests;
