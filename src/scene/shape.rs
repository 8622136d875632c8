//! Shapes of a scene: solids bounded by planes, circles and cylinders, and their combinations.
//!
//! A scene of dimension 1 or 2 leaves the unused axes infinite, so that a block in 2D ignores z.
//! A body is the open inside of its shape: a point on the surface belongs to no body, which keeps
//! two touching bodies from sharing a particle.

use glam::{DVec2, DVec3};
use serde::Deserialize;

/// Distance to the surface, relative to the largest coordinate of the shape, below which a point
/// counts as on it: a lattice point that rounding moved must not become an inner point.
const SURFACE: f64 = 1e-10;

/// A point of a scene as typed: 1 to 3 numbers (m); those left out are 0.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Coordinates(pub Vec<f64>);

impl<const N: usize> From<[f64; N]> for Coordinates {
    fn from(numbers: [f64; N]) -> Self {
        Self(numbers.to_vec())
    }
}

impl Coordinates {
    /// The point as a vector (m).
    pub fn vector(&self) -> DVec3 {
        let number = |axis| self.0.get(axis).copied().unwrap_or(0.0);
        DVec3::new(number(0), number(1), number(2))
    }

    /// The first two coordinates (m).
    pub fn plane(&self) -> DVec2 {
        self.vector().truncate()
    }
}

fn default_axis() -> Coordinates {
    Coordinates::from([0.0, 0.0, 1.0])
}

/// A solid, lengths in m. `center` is the middle of a shape, also along its axis; `axis` is a
/// direction of any length, z where the scene gives none.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// An interval, rectangle or cuboid along the axes.
    Block { min: Coordinates, max: Coordinates },
    /// 2D.
    Disc { center: Coordinates, radius: f64 },
    /// 2D: a disc with a round hole in the middle.
    Ring { center: Coordinates, inner: f64, outer: f64 },
    /// 3D.
    Sphere { center: Coordinates, radius: f64 },
    /// 3D.
    Cylinder {
        center: Coordinates,
        #[serde(default = "default_axis")]
        axis: Coordinates,
        radius: f64,
        length: f64,
    },
    /// 3D: a cylinder with a round bore along its axis.
    Tube {
        center: Coordinates,
        #[serde(default = "default_axis")]
        axis: Coordinates,
        inner: f64,
        outer: f64,
        length: f64,
    },
    /// 2D: the corners in order, either way round; the last joins the first.
    Polygon { points: Vec<Coordinates> },
    /// What is in any of the shapes.
    Union { of: Vec<Shape> },
    /// What is in `from` and in none of `remove`.
    Cut { from: Box<Shape>, remove: Vec<Shape> },
    /// What is in all of the shapes.
    Intersection { of: Vec<Shape> },
}

impl Shape {
    /// Signed distance (m) from `point` to the surface, negative inside. Exact for a primitive; for
    /// a combination never larger in magnitude than the true one, with the right sign.
    pub fn distance(&self, point: DVec3, dimension: usize) -> f64 {
        match self {
            Self::Block { min, max } => block_distance(point, min.vector(), max.vector(), dimension),
            Self::Disc { center, radius } => point.truncate().distance(center.plane()) - radius,
            Self::Ring { center, inner, outer } => wall(point.truncate().distance(center.plane()), *inner, *outer),
            Self::Sphere { center, radius } => point.distance(center.vector()) - radius,
            Self::Cylinder { center, axis, radius, length } => {
                let (height, away) = along_and_away(point - center.vector(), axis.vector());
                corner_distance(away - radius, height.abs() - length / 2.0)
            }
            Self::Tube { center, axis, inner, outer, length } => {
                let (height, away) = along_and_away(point - center.vector(), axis.vector());
                corner_distance(wall(away, *inner, *outer), height.abs() - length / 2.0)
            }
            Self::Polygon { points } => polygon_distance(point.truncate(), points),
            Self::Union { of } => of.iter().map(|part| part.distance(point, dimension)).fold(f64::INFINITY, f64::min),
            Self::Cut { from, remove } => {
                remove.iter().map(|part| -part.distance(point, dimension)).fold(from.distance(point, dimension), f64::max)
            }
            Self::Intersection { of } => of.iter().map(|part| part.distance(point, dimension)).fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// Whether `point` (m) is strictly inside: a point on the surface is not.
    pub fn contains(&self, point: DVec3, dimension: usize) -> bool {
        self.distance(point, dimension) < -self.surface_thickness(dimension)
    }

    /// How near the surface (m) a point counts as on it.
    pub fn surface_thickness(&self, dimension: usize) -> f64 {
        let (min, max) = self.bounds(dimension);
        SURFACE * min.abs().max(max.abs()).max_element()
    }

    /// Lowest and highest corner (m) of a box around the shape; 0 on the unused axes. The lowest is
    /// above the highest on some axis where an intersection is empty.
    pub fn bounds(&self, dimension: usize) -> (DVec3, DVec3) {
        let (min, max) = match self {
            Self::Block { min, max } => (min.vector(), max.vector()),
            Self::Disc { center, radius } | Self::Sphere { center, radius } => around(center, DVec3::splat(*radius)),
            Self::Ring { center, outer, .. } => around(center, DVec3::splat(*outer)),
            Self::Cylinder { center, axis, radius, length } => around(center, reach(axis, *radius, *length)),
            Self::Tube { center, axis, outer, length, .. } => around(center, reach(axis, *outer, *length)),
            Self::Polygon { points } => {
                let corners = points.iter().map(Coordinates::vector);
                corners.fold(NOWHERE, |(min, max), corner| (min.min(corner), max.max(corner)))
            }
            Self::Union { of } => of.iter().map(|part| part.bounds(dimension)).fold(NOWHERE, |a, b| (a.0.min(b.0), a.1.max(b.1))),
            Self::Cut { from, .. } => from.bounds(dimension),
            Self::Intersection { of } => {
                of.iter().map(|part| part.bounds(dimension)).fold((NOWHERE.1, NOWHERE.0), |a, b| (a.0.max(b.0), a.1.min(b.1)))
            }
        };
        (used(min, dimension), used(max, dimension))
    }
}

/// The box that holds nothing.
const NOWHERE: (DVec3, DVec3) = (DVec3::INFINITY, DVec3::NEG_INFINITY);

/// `vector` with the axes that a scene of this dimension lacks set to 0.
pub fn used(vector: DVec3, dimension: usize) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|axis| if axis < dimension { vector[axis] } else { 0.0 }))
}

fn around(center: &Coordinates, reach: DVec3) -> (DVec3, DVec3) {
    (center.vector() - reach, center.vector() + reach)
}

/// Half the size (m) of the box around a cylinder.
fn reach(axis: &Coordinates, radius: f64, length: f64) -> DVec3 {
    let axis = axis.vector().normalize();
    let across = (DVec3::ONE - axis * axis).max(DVec3::ZERO);
    axis.abs() * (length / 2.0) + radius * across.map(f64::sqrt)
}

fn block_distance(point: DVec3, min: DVec3, max: DVec3, dimension: usize) -> f64 {
    let past = (point - (min + max) / 2.0).abs() - (max - min) / 2.0;
    let deepest = (0..dimension).map(|axis| past[axis]).fold(f64::NEG_INFINITY, f64::max);
    used(past.max(DVec3::ZERO), dimension).length() + deepest.min(0.0)
}

/// Distance (m) of radius `away` to the wall between two radii.
fn wall(away: f64, inner: f64, outer: f64) -> f64 {
    (away - (inner + outer) / 2.0).abs() - (outer - inner) / 2.0
}

/// Distance (m) where a side and an end cap meet at a right angle.
fn corner_distance(side: f64, cap: f64) -> f64 {
    side.max(cap).min(0.0) + side.max(0.0).hypot(cap.max(0.0))
}

/// Coordinate along the axis and distance from it (m).
fn along_and_away(offset: DVec3, axis: DVec3) -> (f64, f64) {
    let axis = axis.normalize();
    let height = offset.dot(axis);
    (height, (offset - height * axis).length())
}

fn polygon_distance(point: DVec2, corners: &[Coordinates]) -> f64 {
    let mut nearest = f64::INFINITY;
    let mut inside = false;
    for (corner, next) in edges(corners) {
        let along = next - corner;
        let share = (point - corner).dot(along) / along.length_squared();
        nearest = nearest.min(point.distance(corner + share.clamp(0.0, 1.0) * along));
        // A ray towards +x enters or leaves at each edge that it crosses.
        if (corner.y > point.y) != (next.y > point.y) {
            let crossing = corner.x + (point.y - corner.y) / along.y * along.x;
            inside ^= point.x < crossing;
        }
    }
    if inside { -nearest } else { nearest }
}

/// The edges of a polygon as pairs of corners (m).
pub fn edges(corners: &[Coordinates]) -> impl Iterator<Item = (DVec2, DVec2)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| (a.plane(), b.plane()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Deserialize)]
    struct Body {
        shape: Shape,
    }

    fn parse(text: &str) -> Result<Shape, toml::de::Error> {
        toml::from_str::<Body>(text).map(|body| body.shape)
    }

    #[test]
    fn a_scene_names_shapes_and_integers_are_numbers() {
        let ring = parse("shape = { ring = { center = [0, 0], outer = 35, inner = 30 } }").unwrap();
        let expected = Shape::Ring { center: [0.0, 0.0].into(), inner: 30.0, outer: 35.0 };
        assert_eq!(ring, expected);
        let plate = "shape = { cut = { from = { block = { min = [-40, -40], max = [40, 40] } }, \
                     remove = [{ disc = { center = [0, 0], radius = 10 } }] } }";
        let plate = parse(plate).unwrap();
        assert_eq!(plate.check(2), Ok(()));
        assert!(!plate.contains(DVec3::ZERO, 2));
        assert!(plate.contains(DVec3::new(11.0, 0.0, 7.0), 2));
        let tables = "[shape.cut.from.block]\nmin = [-40, -40]\nmax = [40, 40]\n\n\
                      [[shape.cut.remove]]\ndisc = { center = [0, 0], radius = 10 }\n";
        assert_eq!(parse(tables).unwrap(), plate);
    }

    #[test]
    fn the_axis_is_z_unless_given_and_unknown_words_are_refused() {
        let rod = parse("shape.cylinder = { center = [0, 0, 0], radius = 1, length = 4 }").unwrap();
        assert_eq!(rod.bounds(3).1, DVec3::new(1.0, 1.0, 2.0));
        let error = parse("shape.disc = { center = [0, 0], radius = 1, height = 4 }").unwrap_err();
        assert!(error.to_string().contains("height"));
        assert!(parse("shape.blob = { radius = 1 }").is_err());
    }

    #[test]
    fn distances_are_signed_and_exact() {
        let at = |text: &str, x, y, z, dimension| parse(text).unwrap().distance(DVec3::new(x, y, z), dimension);
        let block = "shape.block = { min = [0, 0, 0], max = [2, 4, 6] }";
        assert_eq!(at(block, 5.0, 8.0, 100.0, 2), 5.0);
        assert_eq!(at(block, 1.5, 100.0, 100.0, 1), -0.5);
        assert_eq!(at(block, 1.0, 2.0, 5.5, 3), -0.5);
        let tube = "shape.tube = { center = [0], axis = [2, 0, 0], inner = 1, outer = 3, length = 8 }";
        assert_eq!(at(tube, 0.0, 0.0, 0.0, 3), 1.0);
        assert_eq!(at(tube, 0.0, 2.5, 0.0, 3), -0.5);
        assert_eq!(at(tube, 7.0, 0.0, 7.0, 3), 5.0);
        let notch = "shape.polygon = { points = [[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]] }";
        assert_eq!(at(notch, 2.0, 0.25, 0.0, 2), -0.25);
        assert!(at(notch, 2.0, 2.0, 0.0, 2) > 0.0);
        assert_eq!(at(notch, -3.0, 8.0, 0.0, 2), 5.0);
    }
}
