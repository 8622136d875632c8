//! From a shape to particles: lattices, concentric rings, and cells fitted to the boundary.
//!
//! A lattice leaves a ragged boundary and the volume right only on average; rings and fitted cells
//! carry exactly the volume of the shape.

use super::clip;
use super::shape::{Shape, used};
use glam::DVec3;
use rayon::prelude::*;
use serde::Deserialize;
use std::f64::consts::{PI, SQRT_2, TAU};

/// Most points that a body may have: beyond it their indices and byte offsets outgrow 32 bits.
pub const MOST_POINTS: usize = (u32::MAX / 8) as usize;

/// How particles are laid out in a shape.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Packing {
    /// Points `spacing` apart along each axis.
    #[default]
    #[serde(alias = "cubic")]
    Square,
    /// The densest lattice, 2D or 3D (face-centred cubic), with `spacing` to the nearest neighbour.
    #[serde(alias = "fcc")]
    Hexagonal,
    /// Concentric circles, 2D or in layers along the axis.
    Rings,
    /// Square cells clipped by the boundary.
    Fitted,
}

/// A particle to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// m; 0 on the unused axes
    pub position: DVec3,
    /// Length (m), area (m2) or volume (m3) in 1D, 2D and 3D.
    pub volume: f64,
}

/// Particles `spacing` (m) apart that fill `shape`, in a fixed order: for lattices and fitted cells
/// by z, then y, then x; for rings by layer, then radius, then angle.
///
/// `anchor` (m) is a point of the lattice or the middle of a fitted cell, [`super::anchor`] where the scene names none; rings do not
/// use it.
///
/// # Errors
/// One sentence where the shape, the spacing or the packing is impossible, where no particle fits,
/// or where there would be more than [`MOST_POINTS`].
pub fn fill(shape: &Shape, packing: Packing, spacing: f64, anchor: DVec3, dimension: usize) -> Result<Vec<Point>, String> {
    shape.check(dimension)?;
    if !(spacing.is_finite() && spacing > 0.0) {
        return Err(format!("spacing must be above 0 and finite, not {spacing}"));
    }
    // Counted on the box around the shape, so that a slip in the unit of the spacing is refused at
    // once instead of filling the memory first.
    let (min, max) = shape.bounds(dimension);
    let sides = (0..dimension).map(|axis| (max[axis] - min[axis]).max(0.0) / spacing);
    let too_many = || format!("spacing {spacing} would need more than {MOST_POINTS} particles");
    if sides.product::<f64>() > f64::from(u32::MAX) {
        return Err(too_many());
    }
    let points = match packing {
        Packing::Square => Lattice::square(spacing, dimension).fill(shape, anchor, dimension),
        Packing::Hexagonal => Lattice::hexagonal(spacing, dimension)?.fill(shape, anchor, dimension),
        Packing::Rings => rings(shape, spacing)?,
        Packing::Fitted => clip::fill(shape, spacing, anchor, dimension),
    };
    match points.len() {
        0 => Err(format!("no particle lies inside the shape at spacing {spacing}: make it smaller")),
        count if count > MOST_POINTS => Err(too_many()),
        _ => Ok(points),
    }
}

/// Rows along x at regular steps of y and z.
pub(super) struct Lattice {
    /// m
    pub step: DVec3,
    /// Every second row begins half a step later, alternating along y and along z.
    pub staggered: bool,
    pub volume: f64,
}

impl Lattice {
    pub fn square(spacing: f64, dimension: usize) -> Self {
        Self { step: DVec3::splat(spacing), staggered: false, volume: spacing.powi(dimension as i32) }
    }

    pub fn hexagonal(spacing: f64, dimension: usize) -> Result<Self, String> {
        let (step, volume) = match dimension {
            2 => {
                let row = 0.75_f64.sqrt() * spacing;
                (DVec3::new(spacing, row, spacing), spacing * row)
            }
            3 => {
                // The cube of the face-centred lattice has four points and neighbours along the
                // diagonals of its faces.
                let cube = SQRT_2 * spacing;
                (cube * DVec3::new(1.0, 0.5, 0.5), cube.powi(3) / 4.0)
            }
            _ => return Err("hexagonal packing needs a 2D or 3D scene".to_string()),
        };
        Ok(Self { step, staggered: true, volume })
    }

    pub fn fill(&self, shape: &Shape, anchor: DVec3, dimension: usize) -> Vec<Point> {
        let (min, max) = shape.bounds(dimension);
        let first = used(((min - anchor) / self.step).floor() - 1.0, dimension);
        let last = used(((max - anchor) / self.step).ceil(), dimension);
        let range = |axis: usize| first[axis] as i64..last[axis] as i64 + 1;
        let surface = shape.surface_thickness(dimension);
        let rows: Vec<(i64, i64)> = range(2).flat_map(|z| range(1).map(move |y| (z, y))).collect();
        let row = |(z, y): (i64, i64)| {
            let late = self.staggered && (y + z).rem_euclid(2) == 1;
            let shift = if late { 0.5 } else { 0.0 };
            range(0)
                .map(move |x| DVec3::new(x as f64 + shift, y as f64, z as f64))
                .map(|index| used(anchor + index * self.step, dimension))
                .filter(|&position| shape.distance(position, dimension) < -surface)
                .map(|position| Point { position, volume: self.volume })
        };
        rows.into_par_iter().flat_map_iter(row).collect()
    }
}

/// Rings of sectors: each particle stands at the centroid of its sector of a circular band and has
/// exactly its volume, so volume and first moment of the body are exact. The bands are equally wide;
/// a solid has a round particle in the middle, half as wide as a band on either side. The first
/// particle of each circle lies towards +x (in 3D: a fixed direction across the axis).
fn rings(shape: &Shape, spacing: f64) -> Result<Vec<Point>, String> {
    let (center, axis, inner, outer, length) = match shape {
        Shape::Disc { center, radius } => (center, DVec3::Z, 0.0, *radius, None),
        Shape::Ring { center, inner, outer } => (center, DVec3::Z, *inner, *outer, None),
        Shape::Cylinder { center, axis, radius, length } => (center, axis.vector(), 0.0, *radius, Some(*length)),
        Shape::Tube { center, axis, inner, outer, length } => (center, axis.vector(), *inner, *outer, Some(*length)),
        _ => return Err("rings packing needs a disc, ring, cylinder or tube".to_string()),
    };
    let axis = axis.normalize();
    let (across, up) = axis.any_orthonormal_pair();
    let sectors = sectors(inner, outer, spacing);
    let length_in_layers = length.unwrap_or(spacing);
    let layers = (length_in_layers / spacing).round().max(1.0);
    let thickness = length_in_layers / layers;
    let layer = |index: usize| {
        let height = (index as f64 + 0.5 - layers / 2.0) * thickness;
        let middle = if length.is_some() { center.vector() + height * axis } else { center.plane().extend(0.0) };
        let thickness = length.map_or(1.0, |_| thickness);
        sectors.iter().map(move |&(x, y, area)| Point { position: middle + x * across + y * up, volume: area * thickness })
    };
    Ok((0..layers as usize).flat_map(layer).collect())
}

/// Position in the plane (m) and area (m2) of each sector of the bands from `inner` to `outer`.
pub(super) fn sectors(inner: f64, outer: f64, spacing: f64) -> Vec<(f64, f64, f64)> {
    let solid = inner == 0.0;
    let middle = if solid { 0.5 } else { 0.0 };
    let bands = ((outer - inner) / spacing - middle).round();
    let bands = if solid { bands.max(0.0) } else { bands.max(1.0) };
    let width = (outer - inner) / (bands + middle);
    let mut sectors = Vec::new();
    if solid {
        sectors.push((0.0, 0.0, PI * (middle * width).powi(2)));
    }
    for band in 0..bands as usize {
        let low = inner + (band as f64 + middle) * width;
        let high = low + width;
        let count = (PI * (low + high) / spacing).round().max(3.0);
        let area = PI * (high * high - low * low) / count;
        let half_angle = PI / count;
        let centroid = 2.0 / 3.0 * (high.powi(3) - low.powi(3)) / (high * high - low * low) * half_angle.sin() / half_angle;
        sectors.extend((0..count as usize).map(|index| {
            let (sine, cosine) = (TAU * index as f64 / count).sin_cos();
            (centroid * cosine, centroid * sine, area)
        }));
    }
    sectors
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(text: &str) -> Shape {
        toml::from_str(text).unwrap()
    }

    fn pack(text: &str, packing: Packing, spacing: f64, dimension: usize) -> Vec<Point> {
        fill(&shape(text), packing, spacing, DVec3::ZERO, dimension).unwrap()
    }

    fn total(points: &[Point]) -> f64 {
        points.iter().map(|point| point.volume).sum()
    }

    fn nearest(points: &[Point]) -> f64 {
        let from = |(index, point): (usize, &Point)| {
            let others = points[..index].iter();
            others.map(|other| point.position.distance(other.position)).fold(f64::INFINITY, f64::min)
        };
        points.iter().enumerate().map(from).fold(f64::INFINITY, f64::min)
    }

    const RING: &str = "ring = { center = [0, 0], inner = 30, outer = 35 }";

    #[test]
    fn a_lattice_keeps_off_the_surface() {
        let disc = "disc = { center = [3, -2], radius = 12 }";
        assert_eq!(pack(disc, Packing::Square, 1.0, 2).len(), 437);
        // Lattice points with 30² < x² + y² < 35², counted one by one.
        let between = |x: i32| move |&y: &i32| (901..1225).contains(&(x * x + y * y));
        let count: usize = (-35..36).map(|x| (-35..36).filter(between(x)).count()).sum();
        assert_eq!(pack(RING, Packing::Square, 1.0, 2).len(), count);
        let bar = pack("block = { min = [0], max = [1] }", Packing::Square, 0.1, 1);
        assert_eq!(bar.len(), 9);
        assert_eq!(bar[0].volume, 0.1);
    }

    #[test]
    fn a_lattice_runs_by_z_then_y_then_x() {
        for packing in [Packing::Square, Packing::Hexagonal] {
            let ball = pack("sphere = { center = [0, 0, 0], radius = 3 }", packing, 1.0, 3);
            let key = |point: &Point| [point.position.z, point.position.y, point.position.x];
            assert!(ball.windows(2).all(|pair| key(&pair[0]) < key(&pair[1])));
        }
    }

    #[test]
    fn hexagonal_neighbours_are_one_spacing_apart_and_fill_the_volume() {
        let cube = "block = { min = [0, 0, 0], max = [10, 10, 10] }";
        for dimension in [2, 3] {
            let points = pack(cube, Packing::Hexagonal, 0.7, dimension);
            assert!((nearest(&points) - 0.7).abs() < 1e-12);
            let middle = points
                .iter()
                .min_by(|a, b| {
                    let off = |point: &Point| (point.position - 5.0).length();
                    off(a).total_cmp(&off(b))
                })
                .unwrap();
            let touching = points.iter().filter(|other| (other.position.distance(middle.position) - 0.7).abs() < 1e-9);
            assert_eq!(touching.count(), [6, 12][dimension - 2]);
            let fine = pack(cube, Packing::Hexagonal, 0.11, dimension);
            assert!((total(&fine) / 10_f64.powi(dimension as i32) - 1.0).abs() < 0.04);
        }
    }

    #[test]
    fn rings_carry_the_exact_volume() {
        let cases = [
            ("disc = { center = [1, 2], radius = 12.3 }", 2, PI * 12.3 * 12.3),
            (RING, 2, PI * (35.0 * 35.0 - 900.0)),
            ("cylinder = { center = [1, 2, 3], axis = [1, 1, 0], radius = 4, length = 10 }", 3, PI * 160.0),
            ("tube = { center = [0, 0, 0], inner = 3, outer = 4, length = 10 }", 3, PI * 70.0),
        ];
        for (text, dimension, volume) in cases {
            let shape = shape(text);
            let points = pack(text, Packing::Rings, 1.0, dimension);
            assert!((total(&points) / volume - 1.0).abs() < 1e-12, "{text}");
            assert!(points.iter().all(|point| shape.contains(point.position, dimension)));
            assert!(nearest(&points) > 0.8, "{text}");
            let moment: DVec3 = points.iter().map(|p| p.volume * p.position).sum();
            let (min, max) = shape.bounds(dimension);
            assert!((moment / volume).distance((min + max) / 2.0) < 1e-12);
        }
        let circles = [30.5_f64, 31.5, 32.5, 33.5, 34.5];
        let expected: f64 = circles.iter().map(|radius| (TAU * radius).round()).sum();
        assert_eq!(pack(RING, Packing::Rings, 1.0, 2).len(), expected as usize);
    }

    #[test]
    fn impossible_requests_are_refused_in_a_sentence() {
        let block = shape("block = { min = [0, 0, 0], max = [1, 1, 1] }");
        let refusal = |packing, spacing, dimension| fill(&block, packing, spacing, DVec3::ZERO, dimension).unwrap_err();
        assert!(refusal(Packing::Square, 0.0, 2).contains("above 0"));
        assert!(refusal(Packing::Square, f64::NAN, 2).contains("above 0"));
        assert!(refusal(Packing::Square, 2.0, 2).contains("no particle"));
        assert!(refusal(Packing::Fitted, 1e-9, 3).contains("more than 536870911"));
        assert!(refusal(Packing::Rings, 0.1, 2).contains("needs a disc"));
        assert!(refusal(Packing::Hexagonal, 0.1, 1).contains("2D or 3D"));
    }

    #[test]
    fn packings_go_by_two_names() {
        #[derive(Deserialize)]
        struct Body {
            packing: Packing,
        }
        let parse = |word: &str| toml::from_str::<Body>(&format!("packing = '{word}'"));
        assert_eq!(parse("cubic").unwrap().packing, Packing::Square);
        assert_eq!(parse("fcc").unwrap().packing, Packing::Hexagonal);
        assert_eq!(parse("fitted").unwrap().packing, Packing::Fitted);
    }
}
