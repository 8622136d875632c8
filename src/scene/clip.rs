//! Cells fitted to the boundary: a particle stands at the centroid of what a lattice cell holds of
//! the shape and has its volume. Exact in 1D and 2D, to about 1e-3 of a cell in 3D.

use super::carve::carve;
use super::packing::Point;
use super::section::Section;
use super::shape::{Shape, used};
use glam::DVec3;
use rayon::prelude::*;

/// Cells that hold less than this share of a full one join a neighbour: a lighter particle would
/// stand close to its neighbours and shorten the time step of the whole body.
pub const SLIVER: f64 = 0.4;

/// Volume, as a share of a full cell, below which a cell counts as empty: rounding errors leave as much where the shape only
/// touches the cell.
const NOTHING: f64 = 1e-12;

/// Points across a face at which two cells are tested for a common face.
const FACE_POINTS: usize = 6;

/// What a cell holds of the shape.
#[derive(Clone, Copy)]
struct Cell {
    /// Along z, y and x, so that cells sort as lattices do.
    index: [i64; 3],
    volume: f64,
    /// First moment about the origin.
    moment: DVec3,
}

struct Grid<'a> {
    shape: &'a Shape,
    spacing: f64,
    anchor: DVec3,
    dimension: usize,
}

/// Particles at the centroids of the cells of side `spacing` (m) about `anchor` + whole multiples of
/// it, clipped by the shape. The volumes add up to that of the shape.
///
/// In a notch or slit narrower than a cell a centroid can lie just outside the shape, and a piece
/// smaller than [`SLIVER`] that has no neighbour cell stays a light particle.
pub fn fill(shape: &Shape, spacing: f64, anchor: DVec3, dimension: usize) -> Vec<Point> {
    let anchor = used(anchor, dimension);
    let grid = Grid { shape, spacing, anchor, dimension };
    grid.merge(grid.cells())
}

impl Grid<'_> {
    fn full(&self) -> f64 {
        self.spacing.powi(self.dimension as i32)
    }

    fn center(&self, index: [i64; 3]) -> DVec3 {
        let [z, y, x] = index.map(|number| number as f64);
        self.anchor + self.spacing * DVec3::new(x, y, z)
    }

    /// All cells that hold something, by z, then y, then x.
    fn cells(&self) -> Vec<Cell> {
        let (min, max) = self.shape.bounds(self.dimension);
        let first = ((min - self.anchor) / self.spacing + 0.5).floor();
        let last = ((max - self.anchor) / self.spacing - 0.5).ceil();
        let (first, last) = (used(first, self.dimension), used(last, self.dimension));
        let range = |axis: usize| first[axis] as i64..last[axis] as i64 + 1;
        let section = Section::new(self.shape, self.dimension);
        let rows: Vec<_> = range(2).flat_map(|z| range(1).map(move |y| (z, y))).collect();
        rows.into_par_iter()
            .flat_map_iter(|(z, y)| {
                let section = &section;
                range(0).map(move |x| self.clip(section, [z, y, x]))
            })
            .filter(|cell| cell.volume > NOTHING * self.full())
            .collect()
    }

    fn clip(&self, section: &Section, index: [i64; 3]) -> Cell {
        let center = self.center(index);
        let distance = self.shape.distance(center, self.dimension);
        let corner = self.spacing / 2.0 * (self.dimension as f64).sqrt();
        let (volume, moment) = if distance >= corner {
            (0.0, DVec3::ZERO)
        } else if distance <= -corner {
            (self.full(), DVec3::ZERO)
        } else if self.dimension == 3 {
            carve(self.shape, center, self.spacing)
        } else {
            let (area, moment) = section.clip(center.truncate(), self.spacing);
            (area, moment.extend(0.0))
        };
        let moment = used(moment, self.dimension) + volume * center;
        Cell { index, volume, moment }
    }

    /// Joins slivers to neighbours, lightest first, until no group is one.
    fn merge(&self, cells: Vec<Cell>) -> Vec<Point> {
        let least = SLIVER * self.full();
        let mut slivers: Vec<usize> = (0..cells.len()).filter(|&index| cells[index].volume < least).collect();
        slivers.sort_by(|&a, &b| cells[a].volume.total_cmp(&cells[b].volume));
        // A group is named by one of its cells, which holds its sums; the others point towards it.
        let mut owner: Vec<usize> = (0..cells.len()).collect();
        let mut groups = cells.clone();
        for sliver in slivers {
            let group = find(&owner, sliver);
            if groups[group].volume >= least {
                continue;
            }
            if let Some(target) = self.partner(&cells, &groups, &owner, sliver) {
                owner[group] = target;
                groups[target].volume += groups[group].volume;
                let moment = groups[group].moment;
                groups[target].moment += moment;
            }
        }
        let leads = |index: &usize| owner[*index] == *index;
        let point = |index: usize| Point { position: groups[index].moment / groups[index].volume, volume: groups[index].volume };
        (0..cells.len()).filter(leads).map(point).collect()
    }

    /// The group of the face neighbour with the largest common face; among equals of the largest
    /// cell, then of the lightest group, so that a thin strip pairs up instead of running together.
    fn partner(&self, cells: &[Cell], groups: &[Cell], owner: &[usize], sliver: usize) -> Option<usize> {
        let own = find(owner, sliver);
        let mut best: Option<(usize, f64, f64, usize)> = None;
        for axis in 0..self.dimension {
            for step in [-1, 1] {
                let mut index = cells[sliver].index;
                index[2 - axis] += step;
                let Ok(neighbour) = cells.binary_search_by_key(&index, |cell| cell.index) else {
                    continue;
                };
                let group = find(owner, neighbour);
                if group == own {
                    continue;
                }
                let face = self.common_face(cells[sliver].index, axis, step as f64);
                let offer = (face, cells[neighbour].volume, -groups[group].volume, group);
                if best.is_none_or(|best| (offer.0, offer.1, offer.2) > (best.0, best.1, best.2)) {
                    best = Some(offer);
                }
            }
        }
        best.map(|(.., group)| group)
    }

    /// How many of the points of a regular pattern on a cell's face are inside the shape.
    fn common_face(&self, index: [i64; 3], axis: usize, side: f64) -> usize {
        let across = |axis: usize| [DVec3::X, DVec3::Y, DVec3::Z][axis % 3] * self.spacing;
        let middle = self.center(index) + side / 2.0 * across(axis);
        let shift = |point: usize| (point as f64 + 0.5) / FACE_POINTS as f64 - 0.5;
        let inside = |&point: &usize| {
            let (first, second) = (point % FACE_POINTS, point / FACE_POINTS);
            let offset = shift(first) * across(axis + 1) + shift(second) * across(axis + 2);
            let position = used(middle + offset, self.dimension);
            self.shape.distance(position, self.dimension) < 0.0
        };
        (0..FACE_POINTS * FACE_POINTS).filter(inside).count()
    }
}

fn find(owner: &[usize], mut index: usize) -> usize {
    while owner[index] != index {
        index = owner[index];
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn shape(text: &str) -> Shape {
        toml::from_str(text).unwrap()
    }

    fn points(text: &str, spacing: f64, dimension: usize) -> Vec<Point> {
        let shape = shape(text);
        shape.check(dimension).unwrap();
        let points = fill(&shape, spacing, DVec3::new(0.1, 0.2, 0.0), dimension);
        let contained = |point: &Point| shape.contains(point.position, dimension);
        assert!(points.iter().all(contained), "{text}");
        assert!(nearest(&points) > SLIVER * spacing, "{text}");
        points
    }

    fn nearest(points: &[Point]) -> f64 {
        let from = |index: usize| {
            let others = points[..index].iter();
            let apart = others.map(|other| points[index].position.distance(other.position));
            apart.fold(f64::INFINITY, f64::min)
        };
        (0..points.len()).into_par_iter().map(from).reduce(|| f64::INFINITY, f64::min)
    }

    fn total(points: &[Point]) -> (f64, DVec3) {
        let volume: f64 = points.iter().map(|point| point.volume).sum();
        let moment: DVec3 = points.iter().map(|p| p.volume * p.position).sum();
        (volume, moment / volume)
    }

    const PLATE: &str = "cut = { from = { block = { min = [-40, -40], max = [40, 40] } }, \
                         remove = [{ disc = { center = [0, 0], radius = 10 } }] }";

    #[test]
    fn plane_shapes_keep_area_and_centroid() {
        // A disc less the lens that it shares with an equal one, E. W. Weisstein, MathWorld,
        // Circle-Circle Intersection: 2 r² acos(d/2r) - d/2 sqrt(4r² - d²).
        let lens = 2.0 * 25.0 * (0.6_f64).acos() - 3.0 * (100.0_f64 - 36.0).sqrt();
        let moon = "cut = { from = { disc = { center = [0, 0], radius = 5 } }, \
                    remove = [{ disc = { center = [6, 0], radius = 5 } }] }";
        let moon_area = PI * 25.0 - lens;
        let cases = [
            ("disc = { center = [1, 2], radius = 7.3 }", PI * 7.3 * 7.3, (1.0, 2.0)),
            ("ring = { center = [0, 0], inner = 30, outer = 35 }", PI * 325.0, (0.0, 0.0)),
            (PLATE, 6400.0 - PI * 100.0, (0.0, 0.0)),
            ("polygon = { points = [[0, 0], [9, 1], [5, 7]] }", 29.0, (14.0 / 3.0, 8.0 / 3.0)),
            (moon, moon_area, (-6.0 * lens / 2.0 / moon_area, 0.0)),
        ];
        for (text, area, centroid) in cases {
            for spacing in [0.37, 1.0] {
                let (sum, center) = total(&points(text, spacing, 2));
                assert!((sum / area - 1.0).abs() < 1e-12, "{text} {sum} {area}");
                let (x, y) = centroid;
                assert!(center.distance(DVec3::new(x, y, 0.0)) < 1e-10, "{text} {center}");
            }
        }
    }

    #[test]
    fn parts_that_touch_or_overlap_count_once() {
        let text = "union = { of = [{ block = { min = [0, 0], max = [4, 4] } }, \
                    { block = { min = [4, 0], max = [8, 4] } }, \
                    { disc = { center = [4, 4], radius = 2 } }] }";
        let (area, center) = total(&points(text, 0.5, 2));
        assert!((area - 32.0 - 2.0 * PI).abs() < 1e-11);
        assert!((center.x - 4.0).abs() < 1e-11);
        let text = "intersection = { of = [{ block = { min = [0, 0], max = [9, 9] } }, \
                    { disc = { center = [0, 0], radius = 8 } }] }";
        let (area, center) = total(&points(text, 0.5, 2));
        assert!((area - 16.0 * PI).abs() < 1e-11);
        assert!((center.x - 32.0 / (3.0 * PI)).abs() < 1e-11);
    }

    #[test]
    fn a_bar_is_exact() {
        let bar = points("block = { min = [0], max = [1.03] }", 0.1, 1);
        let (length, center) = total(&bar);
        assert!((length - 1.03).abs() < 1e-14);
        assert!(center.distance(DVec3::X * 0.515) < 1e-14);
        assert!(bar.iter().all(|point| point.volume >= SLIVER * 0.1));
    }

    #[test]
    fn solids_are_right_to_a_thousandth_of_a_cell() {
        let ball = "sphere = { center = [0, 0, 0], radius = 6.2 }";
        let (volume, center) = total(&points(ball, 1.0, 3));
        let exact = 4.0 / 3.0 * PI * 6.2_f64.powi(3);
        assert!((volume / exact - 1.0).abs() < 1e-4, "{volume} {exact}");
        assert!(center.length() < 1e-4);
        let rod = "cylinder = { center = [0, 0, 0], axis = [1, 1, 1], radius = 3, length = 7 }";
        let (volume, _) = total(&points(rod, 1.0, 3));
        assert!((volume / (63.0 * PI) - 1.0).abs() < 1e-3, "{volume}");
    }

    #[test]
    fn a_strip_thinner_than_a_sliver_stays_a_row() {
        let strip = shape("block = { min = [-0.5, -0.15], max = [9.5, 0.15] }");
        let row = fill(&strip, 1.0, DVec3::ZERO, 2);
        assert_eq!(row.len(), 5);
        assert!(row.iter().all(|point| (point.volume - 0.6).abs() < 1e-12));
    }
}
