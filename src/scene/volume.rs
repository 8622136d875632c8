//! Volume of a shape: what the particles of a body should carry.

use super::carve::carve;
use super::section::Section;
use super::shape::Shape;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Most cubes into which a solid is cut whose volume is no formula.
const MOST_CUBES: f64 = 1e4;

impl Shape {
    /// Length (m), area (m2) or volume (m3) in 1D, 2D and 3D. Exact but for combinations in 3D, which are right to about 1e-4.
    pub fn volume(&self, dimension: usize) -> f64 {
        let (min, max) = self.bounds(dimension);
        let size = max - min;
        if (0..dimension).any(|axis| size[axis] <= 0.0) {
            return 0.0;
        }
        if dimension < 3 {
            // One cell around the whole shape, larger by a quarter so that no side lies on the cell's.
            return Section::new(self, dimension).clip(((min + max) / 2.0).truncate(), 1.25 * size.max_element()).0;
        }
        match self {
            Self::Block { .. } => size.element_product(),
            Self::Sphere { radius, .. } => 4.0 / 3.0 * PI * radius.powi(3),
            Self::Cylinder { radius, length, .. } => PI * radius * radius * length,
            Self::Tube { inner, outer, length, .. } => PI * (outer - inner) * (outer + inner) * length,
            _ => self.carved(min, size),
        }
    }

    /// The sum over cubes of the box from `min` of this size (m).
    fn carved(&self, min: DVec3, size: DVec3) -> f64 {
        let side = (size.element_product() / MOST_CUBES).cbrt();
        let count = (size / side).ceil();
        let first = min + 0.5 * size - 0.5 * (count - 1.0) * side;
        let layer = |z: usize| -> f64 {
            let rows = (0..count.y as usize).flat_map(|y| (0..count.x as usize).map(move |x| (x, y)));
            rows.map(|(x, y)| carve(self, first + side * DVec3::new(x as f64, y as f64, z as f64), side).0).sum()
        };
        // Summed in order, so that the same scene gives the same number.
        (0..count.z as usize).into_par_iter().map(layer).collect::<Vec<f64>>().iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(text: &str, dimension: usize) -> f64 {
        toml::from_str::<Shape>(text).unwrap().volume(dimension)
    }

    #[test]
    fn plane_shapes_are_exact() {
        let plate =
            "cut = { from = { block = { min = [0, 0], max = [9, 4] } }, remove = [{ disc = { center = [4, 2], radius = 1 } }] }";
        let cases = [
            ("block = { min = [0.25], max = [1] }", 1, 0.75),
            ("block = { min = [0, -3], max = [2, 1] }", 2, 8.0),
            ("disc = { center = [5, 7], radius = 1.5 }", 2, PI * 2.25),
            ("ring = { center = [0, 0], inner = 3, outer = 4 }", 2, PI * 7.0),
            ("polygon = { points = [[0, 0], [9, 1], [5, 7]] }", 2, 29.0),
            (plate, 2, 36.0 - PI),
        ];
        for (text, dimension, exact) in cases {
            let found = volume(text, dimension);
            assert!((found / exact - 1.0).abs() < 1e-12, "{text}: {found} {exact}");
        }
    }

    #[test]
    fn solids_are_formulas_and_their_combinations_come_close() {
        let drilled = "cut = { from = { block = { min = [0, 0, 0], max = [8, 4, 1] } }, \
                       remove = [{ cylinder = { center = [3, 2, 0.5], radius = 1, length = 3 } }] }";
        let balls =
            "union = { of = [{ sphere = { center = [0, 0, 0], radius = 1 } }, { sphere = { center = [3, 0, 0], radius = 1 } }] }";
        let cases = [
            ("block = { min = [0, 0, 0], max = [2, 3, 4] }", 24.0, 1e-15),
            ("sphere = { center = [1, 2, 3], radius = 2 }", PI * 32.0 / 3.0, 1e-15),
            ("cylinder = { center = [0, 0, 0], axis = [1, 1, 0], radius = 2, length = 3 }", PI * 12.0, 1e-15),
            ("tube = { center = [0, 0, 0], inner = 1, outer = 2, length = 3 }", PI * 9.0, 1e-15),
            (drilled, 32.0 - PI, 1e-4),
            (balls, PI * 8.0 / 3.0, 1e-4),
        ];
        for (text, exact, tolerance) in cases {
            let found = volume(text, 3);
            assert!((found / exact - 1.0).abs() <= tolerance, "{text}: {found} {exact}");
        }
    }

    #[test]
    fn an_empty_intersection_holds_nothing() {
        let apart =
            "intersection = { of = [{ disc = { center = [0, 0], radius = 1 } }, { disc = { center = [9, 0], radius = 1 } }] }";
        assert_eq!(volume(apart, 2), 0.0);
    }
}
