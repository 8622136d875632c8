//! The exact surface of a shape in facets: points on it with an outward normal and an area, about one spacing apart.
//!
//! Contact acts on facets, each carried by the particle beneath it ([`owners`]), so that a body touches where its
//! shape ends and not half a spacing further in.

mod combination;
mod facet;
mod owners;
mod round;

pub use facet::Facet;
pub use owners::owners;

use super::shape::{Coordinates, Shape, edges};
use combination::Combination;
use glam::{DVec2, DVec3};

/// Facets of the surface of `shape`, about `spacing` (m) apart, in a fixed order; `anchor` (m) is a point of the
/// lattice of particles, above which the facets of blocks stand.
///
/// Areas add up to the surface exactly for every shape but combinations. Those keep what their parts have of their
/// surface: a facet over an edge where parts meet has the part of its area that is left, to about 2 %, and stands in
/// the middle of it.
pub fn facets(shape: &Shape, spacing: f64, anchor: DVec3, dimension: usize) -> Vec<Facet> {
    match shape {
        Shape::Block { min, max } => {
            let sides = Sides { min: min.vector(), max: max.vector(), surface: shape.surface_thickness(dimension) };
            sides.facets(spacing, anchor, dimension)
        }
        Shape::Disc { center, radius } => round::circle(center, *radius, 1.0, spacing),
        Shape::Ring { center, inner, outer } => {
            let hole = round::circle(center, *inner, -1.0, spacing);
            round::circle(center, *outer, 1.0, spacing).into_iter().chain(hole).collect()
        }
        Shape::Sphere { center, radius } => round::sphere(center.vector(), *radius, spacing),
        Shape::Cylinder { center, axis, radius, length } => {
            round::Round { center: center.vector(), axis: axis.vector(), inner: 0.0, outer: *radius, length: *length }
                .facets(spacing)
        }
        Shape::Tube { center, axis, inner, outer, length } => {
            round::Round { center: center.vector(), axis: axis.vector(), inner: *inner, outer: *outer, length: *length }
                .facets(spacing)
        }
        Shape::Polygon { points } => polygon(points, spacing),
        Shape::Union { of } | Shape::Intersection { of } => {
            Combination { whole: shape, parts: of.iter().collect(), dimension }.facets(spacing, anchor)
        }
        Shape::Cut { from, remove } => {
            let parts = std::iter::once(&**from).chain(remove).collect();
            Combination { whole: shape, parts, dimension }.facets(spacing, anchor)
        }
    }
}

/// A block, and how near its surface a lattice point is no particle.
struct Sides {
    min: DVec3,
    max: DVec3,
    surface: f64,
}

impl Sides {
    fn facets(&self, spacing: f64, anchor: DVec3, dimension: usize) -> Vec<Facet> {
        let mut list = Vec::new();
        for axis in 0..dimension {
            let [x, y, z] = std::array::from_fn(|across| match across != axis && across < dimension {
                true => self.pieces(across, spacing, anchor[across]),
                false => vec![(0.0, 1.0)],
            });
            for (side, sign) in [(self.min[axis], -1.0), (self.max[axis], 1.0)] {
                let normal = sign * DVec3::AXES[axis];
                let columns = z.iter().flat_map(|c| y.iter().flat_map(|b| x.iter().map(|a| [*a, *b, *c])));
                list.extend(columns.map(|pieces| {
                    let mut position = DVec3::from_array(pieces.map(|(place, _)| place));
                    position[axis] = side;
                    Facet { position, normal, area: pieces.iter().map(|(_, length)| length).product() }
                }));
            }
        }
        list
    }

    /// Lattice points within the block along an axis, each with the length (m) to halfway its neighbours or to the
    /// block's end; the middle where there is none.
    fn pieces(&self, axis: usize, spacing: f64, anchor: f64) -> Vec<(f64, f64)> {
        let (low, high) = (self.min[axis], self.max[axis]);
        let first = ((low - anchor) / spacing).floor() as i64;
        let last = ((high - anchor) / spacing).ceil() as i64;
        let places = (first..=last).map(|k| anchor + k as f64 * spacing);
        let places: Vec<f64> = places.filter(|place| (low + self.surface..high - self.surface).contains(place)).collect();
        if places.is_empty() {
            return vec![((low + high) / 2.0, high - low)];
        }
        let halfway = places.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0);
        let ends: Vec<f64> = std::iter::once(low).chain(halfway).chain([high]).collect();
        places.into_iter().zip(ends.windows(2)).map(|(place, ends)| (place, ends[1] - ends[0])).collect()
    }
}

/// Each edge in equal pieces, with a facet in the middle of each.
fn polygon(corners: &[Coordinates], spacing: f64) -> Vec<Facet> {
    let turn = edges(corners).map(|(corner, next)| corner.perp_dot(next)).sum::<f64>().signum();
    let edge = |(corner, next): (DVec2, DVec2)| {
        let along = next - corner;
        let count = (along.length() / spacing).round().max(1.0);
        let normal = (-turn * along.perp()).normalize().extend(0.0);
        let place = move |k: usize| (corner + (k as f64 + 0.5) / count * along).extend(0.0);
        (0..count as usize).map(move |k| Facet { position: place(k), normal, area: along.length() / count })
    };
    edges(corners).flat_map(edge).collect()
}

#[cfg(test)]
mod tests;
