//! Copies of a body on a grid, each a body of its own, known together by the name that was typed.

use super::SceneBody;
use super::file::{self, Copies, File};
use super::shape::{Coordinates, Shape};
use glam::DVec3;

/// More bodies than this are taken for a typing error: the tables of pairs of bodies grow with the square of the number.
const MOST: f64 = 10_000.0;

impl Copies {
    /// How far each copy is moved from the middle of the grid; x runs fastest.
    fn shifts(&self, size: DVec3) -> Result<Vec<DVec3>, String> {
        let count = |axis: usize| self.count.get(axis).copied().unwrap_or(1);
        let total: f64 = (0..3).map(|axis| f64::from(count(axis))).product();
        if !(1.0..=MOST).contains(&total) || self.count.len() > 3 {
            return Err(format!("copies.count takes up to three numbers whose product is 1 to {MOST}, found {:?}", self.count));
        }
        let step = size + self.apart.vector();
        let middle = DVec3::from_array(std::array::from_fn(|axis| 0.5 * (f64::from(count(axis)) - 1.0)));
        let grid = (0..count(2)).flat_map(|z| (0..count(1)).flat_map(move |y| (0..count(0)).map(move |x| [x, y, z])));
        Ok(grid.map(|place| (DVec3::from_array(place.map(f64::from)) - middle) * step).collect())
    }
}

/// Puts copies in the place of the bodies that ask for them. For each body then the index of the one that was typed;
/// on failure that index too.
pub(super) fn expand(file: &mut File) -> Result<Vec<usize>, (usize, String)> {
    let mut typed_at = Vec::new();
    let mut all = Vec::new();
    for (k, typed) in std::mem::take(&mut file.body).into_iter().enumerate() {
        let Some(copies) = &typed.copies else {
            typed_at.push(k);
            all.push(typed);
            continue;
        };
        let (low, high) = typed.shape.bounds(file.dimension);
        let shifts = copies.shifts(high - low).map_err(|message| (k, message))?;
        for (number, shift) in shifts.into_iter().enumerate() {
            typed_at.push(k);
            all.push(copy(&typed, number, shift));
        }
    }
    file.body = all;
    Ok(typed_at)
}

fn copy(typed: &file::BodyTable, number: usize, shift: DVec3) -> file::BodyTable {
    let at = |start: DVec3| Coordinates::from((start + shift).to_array());
    let moved = |point: &Coordinates| at(point.vector());
    file::BodyTable {
        name: format!("{} {}", typed.name, number + 1),
        group: Some(typed.name.clone()),
        shape: typed.shape.moved(shift),
        // Without an anchor each lattice is centred in its own shape.
        anchor: typed.anchor.as_ref().map(moved),
        spin_center: Some(typed.spin_center.as_ref().map_or_else(|| at(DVec3::ZERO), moved)),
        ..typed.clone()
    }
}

/// Indices of the bodies that a word names: one, or all copies.
pub(super) fn named(bodies: &[SceneBody], word: &str) -> Vec<usize> {
    (0..bodies.len()).filter(|&k| bodies[k].name == word || bodies[k].group == word).collect()
}

/// Pairs of bodies that two words name. The same word twice means the body itself, or all copies with each other.
pub(super) fn pairs(bodies: &[SceneBody], between: &[String; 2]) -> Vec<(usize, usize)> {
    let (first, second) = (named(bodies, &between[0]), named(bodies, &between[1]));
    let alike = between[0] == between[1] && first.len() > 1;
    let all = first.iter().flat_map(|&a| second.iter().map(move |&b| (a, b)));
    all.filter(|(a, b)| !alike || a < b).collect()
}

impl Shape {
    /// The same shape elsewhere.
    pub fn moved(&self, shift: DVec3) -> Shape {
        let at = |point: &Coordinates| Coordinates::from((point.vector() + shift).to_array());
        let all = |parts: &[Shape]| parts.iter().map(|part| part.moved(shift)).collect();
        let mut shape = self.clone();
        match &mut shape {
            Shape::Block { min, max } => (*min, *max) = (at(min), at(max)),
            Shape::Disc { center, .. }
            | Shape::Ring { center, .. }
            | Shape::Sphere { center, .. }
            | Shape::Cylinder { center, .. }
            | Shape::Tube { center, .. } => *center = at(center),
            Shape::Polygon { points } => *points = points.iter().map(at).collect(),
            Shape::Union { of } | Shape::Intersection { of } => *of = all(of),
            Shape::Cut { from, remove } => (**from, *remove) = (from.moved(shift), all(remove)),
        }
        shape
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_stand_on_a_grid() {
        let copies = Copies { count: vec![2, 3], apart: [0.5, 1.0].into() };
        let size = DVec3::new(2.0, 3.0, 9.0);
        let shifts = copies.shifts(size).unwrap();
        assert_eq!((shifts.len(), shifts[0], shifts[5]), (6, DVec3::new(-1.25, -4.0, 0.0), DVec3::new(1.25, 4.0, 0.0)));
        assert!(Copies { count: vec![0], ..copies.clone() }.shifts(size).is_err());
        assert!(Copies { count: vec![200, 200], ..copies.clone() }.shifts(size).is_err());
        // Four billion cubed has no place in 64 bits.
        assert!(Copies { count: vec![u32::MAX; 3], ..copies }.shifts(size).is_err());
    }

    #[test]
    fn a_shape_moves_with_all_its_parts() {
        let shape: Shape = toml::from_str(
            "cut = { from = { block = { min = [0, 0], max = [4, 4] } }, remove = [{ disc = { center = [2, 2], radius = 1 } }] }",
        )
        .unwrap();
        let moved = shape.moved(DVec3::new(10.0, -3.0, 0.0));
        for point in [DVec3::new(0.5, 0.5, 0.0), DVec3::new(2.0, 2.0, 0.0), DVec3::new(5.0, 1.0, 0.0)] {
            let there = point + DVec3::new(10.0, -3.0, 0.0);
            assert!((shape.distance(point, 2) - moved.distance(there, 2)).abs() < 1e-12);
        }
    }
}
