//! What the particles of each body carry beside what its shape holds, said before the run.

use super::Scene;
use super::file::BodyTable;
use super::packing::Packing;
use super::shape::Shape;
use super::words::rounded;
use serde_json::{Value, json};

/// Relative difference of the volumes from which on a run warns.
const OFF: f64 = 0.01;

/// A body, or all copies of one, as packed.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyMass {
    /// Index of the body, or of the first copy.
    body: usize,
    /// Name of the body, shared by its copies.
    pub name: String,
    pub particles: usize,
    /// Length, area or volume that the particles fill, in units of length to the power of the dimension.
    pub packed: f64,
    /// The same of the shape.
    pub shape: f64,
    /// Mass; in 2D that of a unit of thickness, in 1D that of a unit of cross-section.
    pub mass: f64,
    /// What to do where the two volumes differ much.
    remedy: String,
}

impl BodyMass {
    /// Packed volume over that of the shape, less 1.
    pub fn difference(&self) -> f64 {
        self.packed / self.shape - 1.0
    }

    pub fn json(&self) -> Value {
        json!({
            "name": self.name, "particles": self.particles, "packed_volume": self.packed, "shape_volume": self.shape,
            "relative_difference": self.difference(), "mass": self.mass,
        })
    }
}

impl Scene {
    /// One row for each name of a body, in the order of the scene.
    pub fn masses(&self) -> Vec<BodyMass> {
        let mut list: Vec<BodyMass> = Vec::new();
        // Copies have one shape, whose volume is found once.
        let (mut row_of, mut volumes) = (Vec::new(), Vec::new());
        let dimension = self.dimension();
        for (k, (typed, body)) in self.file.body.iter().zip(&self.bodies).enumerate() {
            let row = list.iter().position(|row| row.name == body.group).unwrap_or_else(|| {
                let (name, remedy) = (body.group.clone(), remedy(typed, body.spacing, dimension));
                list.push(BodyMass { body: k, name, particles: 0, packed: 0.0, shape: 0.0, mass: 0.0, remedy });
                volumes.push(typed.shape.volume(dimension));
                list.len() - 1
            });
            list[row].shape += volumes[row];
            row_of.push(row);
        }
        for particle in &self.particles {
            let body = &self.bodies[particle.body as usize];
            let row = &mut list[row_of[particle.body as usize]];
            row.particles += 1;
            row.packed += particle.volume * body.relative_volume;
            row.mass += particle.volume * body.material.density;
        }
        list
    }

    /// One line for each body: particles, both volumes and the mass.
    pub fn mass_lines(&self) -> Vec<String> {
        let [length, mass, _] = self.unit_names();
        let (volume, mass) = match self.dimension() {
            1 => (length.to_string(), format!("{mass}/{length}^2")),
            2 => (format!("{length}^2"), format!("{mass}/{length}")),
            _ => (format!("{length}^3"), mass.to_string()),
        };
        let line = |row: &BodyMass| {
            format!(
                "`{}`: {} particles fill {} of {} {volume} ({:+.2} %) and weigh {} {mass}",
                row.name,
                row.particles,
                rounded(row.packed, 6),
                rounded(row.shape, 6),
                // Rounding shall not print a minus before a zero.
                (1e4 * row.difference()).round() / 100.0 + 0.0,
                rounded(row.mass, 6)
            )
        };
        self.masses().iter().map(line).collect()
    }

    /// One sentence for each body whose particles carry another volume than its shape has, with the body's index.
    pub(super) fn mass_warnings(&self) -> Vec<(usize, String)> {
        let rows = self.masses();
        let off = rows.iter().filter(|row| row.difference().is_nan() || row.difference().abs() > OFF);
        off.map(|row| {
            let more = if row.difference() > 0.0 { "more" } else { "less" };
            let sentence = format!(
                "the particles of `{}` carry {:.1} % {more} volume and mass than its shape: {}",
                row.name,
                100.0 * row.difference().abs(),
                row.remedy
            );
            (row.body, sentence)
        })
        .collect()
    }
}

/// How a body gets the volume of its shape.
fn remedy(typed: &BodyTable, spacing: f64, dimension: usize) -> String {
    let fitted = "`packing = \"fitted\"` carries it exactly";
    let Shape::Block { min, max } = &typed.shape else { return fitted.into() };
    if typed.packing() != Packing::Square {
        return fitted.into();
    }
    let size = max.vector() - min.vector();
    let sides = || (0..dimension).map(|axis| size[axis]);
    let divides = |spacing: f64| sides().all(|side| ((side / spacing).round() * spacing / side - 1.0).abs() < 1e-6);
    if divides(spacing) {
        return format!("leave its `anchor` out, and the block is filled to its faces, or {fitted}");
    }
    let shortest = sides().fold(f64::INFINITY, f64::min);
    let counts = (shortest / spacing).round().max(1.0);
    let near = [counts, counts + 1.0, counts - 1.0].into_iter().filter(|&count| count > 0.0).map(|count| shortest / count);
    let near = near.into_iter().find(|&spacing| divides(spacing));
    let finer = near.map_or_else(String::new, |spacing| format!(" {}", rounded(spacing, 6)));
    format!("{fitted}, or take a spacing{finer} that divides its sides")
}
