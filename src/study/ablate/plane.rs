//! One dimension less: plane strain for a scene in space, uniaxial strain for one in the plane, where every body spans
//! the same stretch of the last axis and nothing varies or moves along it.

use super::piece::{Piece, Sort, without};
use super::uniform::{alike, along, flattened, span};
use crate::scene::Scene;
use crate::scene::file::{Axis, BodyTable, Boundary, Expect, File, Fixed, Motion, Observe, ObstacleShape, Scale};
use crate::scene::shape::Coordinates;

/// Kinds of observables that are sums over particles, and so in proportion to the length of the axis.
const SUMS: [&str; 14] = [
    "kinetic_energy",
    "elastic_energy",
    "internal_energy",
    "dissipated_energy",
    "hourglass_energy",
    "contact_energy",
    "total_energy",
    "momentum",
    "angular_momentum",
    "force",
    "obstacle_force",
    "contact_area",
    "work",
    "unloading_stiffness",
];

/// Whether an observable is in proportion to the length of the axis that falls away.
pub fn is_sum(typed: &Observe) -> bool {
    SUMS.contains(&typed.kind.as_str())
}

/// An expectation of a sum over a unit of the axis.
pub fn per_width(expect: &Expect, width: f64) -> Expect {
    let over = |value: Option<f64>| value.map(|value| value / width);
    let tolerance = if expect.relative { expect.tolerance } else { over(expect.tolerance) };
    Expect {
        value: over(expect.value),
        seen: over(expect.seen),
        tolerance,
        scale: match expect.scale {
            Some(Scale::Number(scale)) => Some(Scale::Number(scale / width)),
            word => word,
        },
        between: expect.between.map(|range| range.map(|end| end / width)),
        ..expect.clone()
    }
}

/// The lower dimension, or why the scene has none.
pub fn piece(scene: &Scene, file: &File) -> Piece {
    let name = format!("dimension {} instead of {}", file.dimension.saturating_sub(1), file.dimension);
    match Lower::new(scene, file).and_then(|lower| lower.overrides().map(|overrides| (overrides, lower.width()))) {
        Ok((overrides, width)) => Piece { width: Some(width), ..Piece::new(name, Sort::Reduced, overrides) },
        Err(reason) => Piece::refused(name, Sort::Reduced, reason),
    }
}

struct Lower<'a> {
    scene: &'a Scene,
    file: &'a File,
    /// The axis that falls away.
    axis: usize,
    /// What all bodies span of it.
    range: [f64; 2],
}

impl<'a> Lower<'a> {
    fn new(scene: &'a Scene, file: &'a File) -> Result<Self, String> {
        let axis = file.dimension.checked_sub(1).filter(|&axis| axis > 0).ok_or("a line has no dimension to lose")?;
        if file.body.iter().any(|body| body.copies.is_some()) {
            return Err("it has copies of a body, which stand on a grid of all dimensions".into());
        }
        let mut range = None;
        for body in &file.body {
            let own = span(&body.shape, axis).ok_or_else(|| format!("`{}` is not uniform along {}", body.name, NAMES[axis]))?;
            if range.is_some_and(|range| !alike(range, own)) {
                return Err(format!("its bodies span different stretches of {}", NAMES[axis]));
            }
            range = Some(own);
        }
        let range = range.ok_or("it has no body")?;
        Ok(Self { scene, file, axis, range })
    }

    fn width(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    fn overrides(&self) -> Result<Vec<String>, String> {
        let file = self.file;
        let mut list = vec![format!("dimension={}", self.axis)];
        for body in &file.body {
            list.extend(self.body(body)?);
        }
        for (k, boundary) in file.boundary.iter().enumerate() {
            list.extend(self.boundary(k, boundary)?);
        }
        for obstacle in &file.obstacle {
            self.flat(&format!("the velocity of obstacle `{}`", obstacle.name), obstacle.velocity.as_ref())?;
            list.extend(self.obstacle(&obstacle.name, &obstacle.shape)?);
        }
        for (k, mirror) in file.symmetry.iter().enumerate() {
            let normal = mirror.normal.vector().to_array();
            let along = normal[self.axis] != 0.0;
            if along && (0..self.axis).any(|axis| normal[axis] != 0.0) {
                return Err(format!("mirror {k} is inclined to {}", NAMES[self.axis]));
            }
            list.extend(along.then(|| without(&format!("symmetry.{k}"))));
        }
        for kick in &file.kick {
            self.flat("a kick", Some(&kick.velocity))?;
        }
        if file.kick.iter().any(|kick| (kick.velocity.vector().length()) > 0.0) {
            return Err(format!("one particle is kicked, which is not uniform along {}", NAMES[self.axis]));
        }
        for (key, typed) in [("periodic", &file.periodic), ("body_force", &file.body_force)] {
            if let Some(numbers) = typed {
                if key == "body_force" {
                    self.flat("the body force", Some(&Coordinates(numbers.clone())))?;
                }
                list.push(format!("{key}={:?}", &numbers[..self.axis]));
            }
        }
        Ok(list)
    }

    fn body(&self, body: &BodyTable) -> Result<Vec<String>, String> {
        let path = format!("body.{}", body.name);
        let named = |what: &str| format!("{what} of `{}`", body.name);
        self.flat(&named("the velocity"), body.velocity.as_ref())?;
        let axis = body.spin_axis.as_ref().map_or([0.0, 0.0, 1.0], |axis| axis.vector().to_array());
        let turns = body.spin != 0.0 && (self.axis < 2 || axis[0] != 0.0 || axis[1] != 0.0);
        if turns {
            return Err(format!("{} turns it out of what is left", named("the spin")));
        }
        let mut list: Vec<String> =
            flattened(&body.shape, self.axis).map(|shape| format!("{path}.shape={shape}")).into_iter().collect();
        let wave = |wave: &crate::scene::file::Wave, what: &str| {
            self.flat(&named(what), Some(&wave.amplitude))?;
            self.flat(&named(what), Some(&wave.wave_vector))
        };
        if let Some(flaw) = &body.flaw {
            wave(flaw, "the flaw")?;
        }
        match &body.motion {
            None => {}
            Some(Motion::Wave(typed)) => wave(typed, "the motion")?,
            Some(Motion::Gradient(rows)) => list.extend(
                self.gradient(&path, rows).ok_or_else(|| format!("{} varies along {}", named("the motion"), NAMES[self.axis]))?,
            ),
            Some(Motion::Cantilever(typed)) => {
                self.flat(&named("the motion"), Some(&typed.tip))?;
                self.flat(&named("the motion"), Some(&typed.axis))?;
            }
            Some(Motion::Twist(_)) => return Err(format!("{} twists it", named("the motion"))),
        }
        Ok(list)
    }

    /// The leading rows and columns, where the others are zero.
    fn gradient(&self, path: &str, rows: &[Vec<f64>]) -> Option<Option<String>> {
        let flat = rows
            .iter()
            .enumerate()
            .all(|(i, row)| row.iter().enumerate().all(|(j, &number)| (i < self.axis && j < self.axis) || number == 0.0));
        let kept: Vec<&[f64]> = rows.iter().take(self.axis).map(|row| &row[..row.len().min(self.axis)]).collect();
        flat.then(|| (rows.len() > self.axis).then(|| format!("{path}.motion.gradient={kept:?}")))
    }

    fn boundary(&self, k: usize, boundary: &Boundary) -> Result<Vec<String>, String> {
        let name = boundary.name.clone().unwrap_or_else(|| format!("boundary {}", k + 1));
        let mut list = Vec::new();
        if let Some(shape) = &boundary.select.inside {
            let own = span(shape, self.axis).filter(|own| own[0] <= self.range[0] && own[1] >= self.range[1]);
            own.ok_or_else(|| format!("`{name}` selects a part of {}", NAMES[self.axis]))?;
            list.extend(flattened(shape, self.axis).map(|shape| format!("boundary.{k}.select.inside={shape}")));
        }
        self.flat(&format!("the force of `{name}`"), boundary.force.as_ref())?;
        if let Some(force) = &boundary.force {
            let over = |axis: usize| force.vector().to_array()[axis] / self.width();
            list.push(format!("boundary.{k}.force={:?}", (0..self.axis).map(over).collect::<Vec<f64>>()));
        }
        if let Some(Fixed::Axes(axes)) = &boundary.fixed {
            list.push(format!("boundary.{k}.fixed={:?}", &axes[..self.axis]));
        }
        if let Some(velocity) = &boundary.velocity {
            let moves = velocity.get(self.axis).is_some_and(|axis| matches!(axis, Axis::Value(value) if *value != 0.0));
            if moves {
                return Err(format!("`{name}` moves along {}", NAMES[self.axis]));
            }
            let word = |axis: &Axis| match axis {
                Axis::Value(value) => format!("{value:?}"),
                Axis::Word(_) => "\"free\"".into(),
            };
            let words: Vec<String> = velocity.iter().take(self.axis).map(word).collect();
            list.push(format!("boundary.{k}.velocity=[{}]", words.join(", ")));
        }
        Ok(list)
    }

    fn obstacle(&self, name: &str, shape: &ObstacleShape) -> Result<Option<String>, String> {
        let shape = match shape {
            ObstacleShape::Plane { normal, .. } => {
                self.flat(&format!("the normal of obstacle `{name}`"), Some(normal))?;
                return Ok(None);
            }
            ObstacleShape::Cylinder { center, axis, radius } if self.axis == 2 && along(axis) => {
                format!("{{ sphere = {{ center = {:?}, radius = {radius:?} }} }}", &center.vector().to_array()[..2])
            }
            _ => return Err(format!("obstacle `{name}` is not uniform along {}", NAMES[self.axis])),
        };
        Ok(Some(format!("obstacle.{name}.shape={shape}")))
    }

    /// Refuses a vector with a part along the axis.
    fn flat(&self, what: &str, vector: Option<&Coordinates>) -> Result<(), String> {
        let part = vector.map_or(0.0, |vector| vector.vector().to_array()[self.axis]);
        let dimension = self.scene.dimension();
        if part == 0.0 { Ok(()) } else { Err(format!("{what} has a part along {}, axis {dimension}", NAMES[self.axis])) }
    }
}

const NAMES: [&str; 3] = ["x", "y", "z"];

#[cfg(test)]
mod tests {
    use super::*;

    const BAR: &str = r#"
title = "a bar"
dimension = 3
spacing = 0.1
duration = 1
body_force = [1, 0, 0]
[[body]]
name = "bar"
shape = { cut = { from = { block = { min = [0, 0, 0], max = [1, 0.5, 0.4] } }, remove = [{ cylinder = { center = [0.5, 0.25, 0.2], radius = 0.1, length = 1 } }] } }
anchor = [0.05, 0.05, 0.05]
material = "m"
motion = { wave = { amplitude = [0.1], wave_vector = [0, 3] } }
[material.m]
density = 1
youngs_modulus = 1
poisson_ratio = 0.3
[[boundary]]
name = "end"
select.inside = { block = { min = [-1, -1, -1], max = [0.2, 1, 1] } }
fixed = [true, false, true]
force = [0, 2, 0]
"#;

    fn lowered(text: &str) -> Piece {
        let scene = Scene::parse(text, "bar", None, &[]).unwrap();
        piece(&scene, &scene.file)
    }

    #[test]
    fn a_uniform_scene_loses_its_last_axis() {
        let piece = lowered(BAR);
        assert_eq!((piece.refused.clone(), piece.width), (None, Some(0.4)));
        let flat = Scene::parse(BAR, "bar", None, &piece.overrides).unwrap();
        assert_eq!(flat.dimension(), 2);
        let solid = Scene::parse(BAR, "bar", None, &[]).unwrap();
        assert_eq!(solid.particles.len(), 4 * flat.particles.len());
        // The same acceleration, of the force over the mass.
        let (a, b) = (&flat.constraints[0], &solid.constraints[0]);
        assert!(a.prescribed == [true, false, false] && (a.vector[1] / b.vector[1] - 1.0).abs() < 1e-9, "{a:?} {b:?}");
    }

    #[test]
    fn what_varies_along_the_axis_is_named() {
        let refuse = |from: &str, to: &str, word: &str| {
            let text = BAR.replace(from, to);
            assert!(text != BAR, "{from}");
            let reason = lowered(&text).refused.unwrap();
            assert!(reason.contains(word), "{reason}");
        };
        refuse("wave_vector = [0, 3]", "wave_vector = [0, 3, 1]", "the motion of `bar` has a part along z");
        refuse("amplitude = [0.1]", "amplitude = [0.1, 0, 1]", "the motion of `bar` has a part along z");
        refuse("radius = 0.1, length = 1", "radius = 0.1, length = 0.2", "`bar` is not uniform along z");
        refuse("max = [0.2, 1, 1]", "max = [0.2, 1, 0.2]", "`end` selects a part of z");
        let free = "fixed = [true, false, false]\nforce = [0, 2, 1]";
        refuse("fixed = [true, false, true]\nforce = [0, 2, 0]", free, "the force of `end` has a part along z");
        refuse("body_force = [1, 0, 0]", "body_force = [1, 0, -1]", "the body force has a part along z");
    }
}
