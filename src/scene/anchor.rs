//! Where the lattice of a body lies that names no anchor: in the middle of the shape's box, with as many cells in each
//! direction as the box is long, so that a box of whole multiples of the spacing is filled to its faces.

use super::file::BodyTable;
use super::packing::{Lattice, Packing};
use super::shape::{Shape, used};
use glam::DVec3;

/// Cells of the box up to which other placements are tried on a shape that is no block. In a larger one they differ by less than
/// a thousandth of the volume.
const FEW: f64 = 1e5;

impl BodyTable {
    /// A point of the body's lattice (m): the anchor that the scene names, or the one that centres the lattice.
    pub(super) fn lattice_anchor(&self, spacing: f64, dimension: usize) -> DVec3 {
        match &self.anchor {
            Some(typed) => used(typed.vector(), dimension),
            None => centred(&self.shape, self.packing(), spacing, dimension),
        }
    }
}

/// The anchor (m) of a lattice that is centred in the box around `shape`. With n the whole number of cells nearest to the box's
/// length, n points of it lie in a row across the box, the first half a cell off the face where the length is n cells.
///
/// Where the shape is no block, the lattice lies in each direction on the middle of the box or half a cell beside it, whichever
/// gives the body the volume nearest to the shape's; directions of equal length do so together, so that a disc has the symmetry
/// of its lattice. A shape or a spacing that [`super::packing::fill`] refuses has the origin.
pub fn centred(shape: &Shape, packing: Packing, spacing: f64, dimension: usize) -> DVec3 {
    let lattice = match packing {
        Packing::Hexagonal => Lattice::hexagonal(spacing, dimension),
        _ => Ok(Lattice::square(spacing, dimension)),
    };
    let sound = shape.check(dimension).is_ok() && spacing.is_finite() && spacing > 0.0;
    let Some(lattice) = lattice.ok().filter(|_| sound) else { return DVec3::ZERO };
    let (min, max) = shape.bounds(dimension);
    let cells = (max - min) / lattice.step;
    let count = cells.map(|length| length.round().max(1.0));
    // An even number of points stands on both sides of the middle, an odd one has a point in it.
    let beside = |count: DVec3| count.map(|count| if count.rem_euclid(2.0) == 0.0 { 0.5 } else { 0.0 });
    // Rows that begin late by half a step hold as many points as the others where both are a quarter off the middle.
    let late = if lattice.staggered { DVec3::X * 0.25 } else { DVec3::ZERO };
    let place = |offset: DVec3| used((min + max) / 2.0 + offset * lattice.step, dimension);
    let usual = place(beside(count) + late);
    let few = (0..dimension).map(|axis| cells[axis].max(0.0)).product::<f64>() < FEW;
    if matches!(shape, Shape::Block { .. }) || matches!(packing, Packing::Fitted | Packing::Rings) || !few {
        return usual;
    }
    let exact = shape.volume(dimension);
    let off = |anchor: DVec3| {
        let packed = lattice.fill(shape, anchor, dimension).len() as f64 * lattice.volume;
        (packed / exact - 1.0).abs()
    };
    let others = shifts(cells, dimension).into_iter().map(|shift| place(beside(count) + shift));
    let mut best = (usual, off(usual));
    for anchor in others {
        let off = off(anchor);
        // Rounding does not choose between placements that are as good as each other.
        if off < best.1 - 1e-9 {
            best = (anchor, off);
        }
    }
    best.0
}

/// Half a cell along some of the directions, or along none; directions in which the box has equally many cells go together.
fn shifts(cells: DVec3, dimension: usize) -> Vec<DVec3> {
    let alike = |a: usize, b: usize| (cells[a] - cells[b]).abs() < 1e-9 * cells[a];
    let leader: Vec<usize> = (0..dimension).map(|axis| (0..axis).find(|&other| alike(axis, other)).unwrap_or(axis)).collect();
    let mut leaders = leader.clone();
    leaders.sort_unstable();
    leaders.dedup();
    let shift = |mask: usize| {
        let moved = |axis: usize| leaders.iter().position(|&of| of == leader[axis]).is_some_and(|bit| mask >> bit & 1 == 1);
        DVec3::from_array(std::array::from_fn(|axis| if axis < dimension && moved(axis) { 0.5 } else { 0.0 }))
    };
    (0..1 << leaders.len()).map(shift).collect()
}

#[cfg(test)]
mod tests {
    use super::super::packing::{Point, fill};
    use super::*;

    fn shape(text: &str) -> Shape {
        toml::from_str(text).unwrap()
    }

    fn pack(text: &str, packing: Packing, spacing: f64, dimension: usize) -> Vec<Point> {
        let shape = shape(text);
        fill(&shape, packing, spacing, centred(&shape, packing, spacing, dimension), dimension).unwrap()
    }

    fn total(points: &[Point]) -> f64 {
        points.iter().map(|point| point.volume).sum()
    }

    #[test]
    fn a_box_of_whole_cells_is_filled_to_its_faces() {
        let cases = [
            ("block = { min = [0.3], max = [1.3] }", 0.1, 1, 10),
            ("block = { min = [0, 0], max = [0.2, 0.2] }", 0.02, 2, 100),
            ("block = { min = [0, -0.05], max = [1, 0.05] }", 0.0125, 2, 640),
            ("block = { min = [-0.5, 2], max = [0.4, 2.5] }", 0.1, 2, 45),
            ("block = { min = [0, 0, 0], max = [0.4, 0.3, 0.5] }", 0.1, 3, 60),
        ];
        for packing in [Packing::Square, Packing::Fitted] {
            for (text, spacing, dimension, count) in cases {
                let points = pack(text, packing, spacing, dimension);
                let exact = shape(text).volume(dimension);
                assert_eq!(points.len(), count, "{text}");
                assert!((total(&points) / exact - 1.0).abs() < 1e-12, "{text}");
                // The outermost points stand half a spacing off the faces.
                let (min, max) = shape(text).bounds(dimension);
                let lowest = points.iter().fold(DVec3::INFINITY, |low, point| low.min(point.position));
                let highest = points.iter().fold(DVec3::NEG_INFINITY, |high, point| high.max(point.position));
                let half = used(DVec3::splat(spacing / 2.0), dimension);
                assert!(lowest.distance(min + half).max(highest.distance(max - half)) < 1e-12, "{text}");
            }
        }
    }

    #[test]
    fn staggered_rows_of_a_box_hold_equally_many() {
        let row = 0.75_f64.sqrt();
        let plane = format!("block = {{ min = [0, 0], max = [7, {}] }}", 5.0 * row);
        let points = pack(&plane, Packing::Hexagonal, 1.0, 2);
        assert_eq!(points.len(), 35);
        assert!((total(&points) / shape(&plane).volume(2) - 1.0).abs() < 1e-12);
        let cube = 2_f64.sqrt();
        let solid = format!("block = {{ min = [0, 0, 0], max = [{}, {}, {}] }}", 3.0 * cube, 2.0 * cube, 2.5 * cube);
        let points = pack(&solid, Packing::Hexagonal, 1.0, 3);
        assert_eq!(points.len(), 3 * 4 * 5);
        assert!((total(&points) / shape(&solid).volume(3) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_box_of_other_length_has_the_nearest_number_of_cells() {
        for (length, count) in [(1.04, 10), (1.06, 11), (0.96, 10), (0.03, 1)] {
            let bar = format!("block = {{ min = [0.7], max = [{}] }}", 0.7 + length);
            let points = pack(&bar, Packing::Square, 0.1, 1);
            assert_eq!(points.len(), count, "{length}");
            let middle: DVec3 = points.iter().map(|point| point.position).sum::<DVec3>() / count as f64;
            assert!((middle.x - 0.7 - length / 2.0).abs() < 1e-12);
        }
    }

    #[test]
    fn round_shapes_are_symmetric_and_lose_little() {
        for packing in [Packing::Square, Packing::Hexagonal] {
            for (text, dimension) in [
                ("disc = { center = [3, 7], radius = 12 }", 2),
                ("ring = { center = [0, 0], inner = 30, outer = 35 }", 2),
                ("sphere = { center = [1, 0, 0], radius = 6 }", 3),
            ] {
                let exact = shape(text).volume(dimension);
                let points = pack(text, packing, 1.0, dimension);
                let found = total(&points) / exact - 1.0;
                assert!(found.abs() < 0.013, "{text} {packing:?} {found}");
                if packing == Packing::Square {
                    let (min, max) = shape(text).bounds(dimension);
                    let middle = points.iter().map(|point| point.position).sum::<DVec3>() / points.len() as f64;
                    assert!(middle.distance((min + max) / 2.0) < 1e-12, "{text}");
                }
            }
        }
    }
}
