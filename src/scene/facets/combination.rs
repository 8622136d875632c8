//! Facets of unions, cuts and intersections: those of the parts, as far as they are on the surface of the whole.

use super::{Facet, facets};
use crate::scene::shape::Shape;
use glam::DVec3;

/// How far from the surface, over the spacing, a point must be in or out of a shape for a facet to stand there.
const STEP: f64 = 1e-3;
/// Points of a facet that are tried where parts meet: a square of 8 by 8, in 2D a line.
const SAMPLES: usize = 64;

/// A shape with the parts that it is made of.
pub(super) struct Combination<'a> {
    pub whole: &'a Shape,
    pub parts: Vec<&'a Shape>,
    pub dimension: usize,
}

impl Combination<'_> {
    pub fn facets(&self, spacing: f64, anchor: DVec3) -> Vec<Facet> {
        let mut list = Vec::new();
        for (index, part) in self.parts.iter().enumerate() {
            let of_part = facets(part, spacing, anchor, self.dimension);
            list.extend(of_part.iter().filter_map(|facet| self.keep(index, facet, STEP * spacing)));
        }
        list
    }

    /// What is left of a facet of a part, turned to point out of the whole.
    fn keep(&self, part: usize, facet: &Facet, step: f64) -> Option<Facet> {
        let side = facet.area.powf(1.0 / (self.dimension as f64 - 1.0).max(1.0));
        let step = step * facet.normal;
        let mut others = self.parts.iter().enumerate().filter(|(index, _)| *index != part);
        let meets = self.dimension > 1 && others.any(|(_, shape)| shape.distance(facet.position, self.dimension).abs() < side);
        if !meets {
            return self.is_kept(part, facet.position, step).then(|| self.turned(*facet, step));
        }
        let own = |position: &DVec3| self.separates(self.parts[part], *position, step);
        let all: Vec<DVec3> = self.samples(facet, side).map(|place| self.onto(part, place, facet.normal)).filter(own).collect();
        let kept: Vec<DVec3> = all.iter().copied().filter(|&place| self.is_kept(part, place, step)).collect();
        if kept.is_empty() || kept.len() == all.len() {
            return (!kept.is_empty()).then(|| self.turned(*facet, step));
        }
        let middle = self.onto(part, kept.iter().sum::<DVec3>() / kept.len() as f64, facet.normal);
        let normal = self.slope(part, middle, step.length(), facet.normal);
        let share = kept.len() as f64 / all.len() as f64;
        let left = Facet { position: self.onto(part, middle, normal), normal, area: share * facet.area };
        // The middle of what is left of an edge need not be on the surface of the whole.
        let sign = self.turned(Facet { position: kept[0], ..*facet }, step).normal.dot(facet.normal);
        Some(Facet { normal: sign.signum() * normal, ..left })
    }

    /// Normal of the surface of a part, on the same side as a normal nearby.
    fn slope(&self, part: usize, position: DVec3, step: f64, normal: DVec3) -> DVec3 {
        let at = |axis: DVec3| self.parts[part].distance(position + step * axis, self.dimension);
        let along = DVec3::AXES.map(|axis| at(axis) - at(-axis));
        let slope = DVec3::from_array(along).normalize();
        slope.dot(normal).signum() * slope
    }

    /// Whether the surface of a shape lies between the two sides of a place.
    fn separates(&self, shape: &Shape, position: DVec3, step: DVec3) -> bool {
        shape.contains(position - step, self.dimension) != shape.contains(position + step, self.dimension)
    }

    /// Whether a place on the surface of a part is on that of the whole; a surface that parts share is the first one's.
    fn is_kept(&self, part: usize, position: DVec3, step: DVec3) -> bool {
        let earlier = &self.parts[..part];
        self.separates(self.whole, position, step) && !earlier.iter().any(|shape| self.separates(shape, position, step))
    }

    fn turned(&self, facet: Facet, step: DVec3) -> Facet {
        let sign = if self.whole.contains(facet.position - step, self.dimension) { 1.0 } else { -1.0 };
        Facet { normal: sign * facet.normal, ..facet }
    }

    /// Points of a square (in 2D of a line) in the tangent plane, as large as the facet.
    fn samples(&self, facet: &Facet, side: f64) -> impl Iterator<Item = DVec3> {
        let (columns, across, up) = match self.dimension {
            2 => (SAMPLES, facet.normal.cross(DVec3::Z), DVec3::ZERO),
            _ => (SAMPLES.isqrt(), facet.normal.any_orthonormal_pair().0, facet.normal.any_orthonormal_pair().1),
        };
        let along = move |k: usize| ((k as f64 + 0.5) / columns as f64 - 0.5) * side;
        let position = facet.position;
        (0..SAMPLES).map(move |k| position + along(k % columns) * across + along(k / columns) * up)
    }

    /// Where a point near the surface of a part comes onto it along a normal nearby. Each of the two steps leaves less
    /// than (angle between normals)^2/2 of the distance.
    fn onto(&self, part: usize, point: DVec3, normal: DVec3) -> DVec3 {
        (0..2).fold(point, |point, _| point - self.parts[part].distance(point, self.dimension) * normal)
    }
}
