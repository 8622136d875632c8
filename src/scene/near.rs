//! Which particle lies nearest to a place, and what to say where none is near.

use super::shape::{Shape, used};
use super::{Particle, SceneBody};
use glam::DVec3;

/// What is there to be near to: the particles that a selection leaves, by their numbers, with their bodies.
pub(crate) struct Near<'a> {
    pub bodies: &'a [SceneBody],
    pub particles: &'a [Particle],
    pub dimension: usize,
}

impl Near<'_> {
    /// Number of the particle nearest to a point, among those that are chosen.
    ///
    /// # Errors
    /// Where the point lies outside: farther than the diagonal of a cell of the lattice, which is how far the corner of a body
    /// may be from the last particle of a lattice that puts none on the surface.
    pub fn point(&self, point: DVec3, chosen: impl Fn(usize) -> bool) -> Result<usize, String> {
        let point = used(point, self.dimension);
        let Some((i, distance)) = self.least(chosen, |particle| particle.position.distance(point)) else {
            return Err("selects no particle".into());
        };
        let spacing = self.bodies[self.particles[i].body as usize].spacing;
        if distance <= spacing * (self.dimension as f64).sqrt() * (1.0 + 1e-9) {
            return Ok(i);
        }
        Err(format!(
            "sits at {}, {} away from the nearest particle, {}, where the spacing is {spacing}: it must be a point of a body",
            self.place(point),
            rounded(distance),
            self.particle(i)
        ))
    }

    /// What is said of a selection that holds no particle: where the nearest one is.
    pub fn none_in(&self, shape: Option<&Shape>, chosen: impl Fn(usize) -> bool) -> String {
        let outside = |shape: &Shape| self.least(chosen, |particle| shape.distance(particle.position, self.dimension));
        match shape.and_then(outside) {
            Some((i, distance)) if distance <= shape.map_or(0.0, |shape| shape.surface_thickness(self.dimension)) => format!(
                "selects no particle: the nearest, {}, lies on the surface of the shape, which counts as outside",
                self.particle(i)
            ),
            Some((i, distance)) => {
                format!("selects no particle: the nearest, {}, lies {} outside the shape", self.particle(i), rounded(distance))
            }
            None => "selects no particle".into(),
        }
    }

    fn least(&self, chosen: impl Fn(usize) -> bool, measure: impl Fn(&Particle) -> f64) -> Option<(usize, f64)> {
        let of = |i: usize| (i, measure(&self.particles[i]));
        (0..self.particles.len()).filter(|&i| chosen(i)).map(of).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn particle(&self, i: usize) -> String {
        let particle = &self.particles[i];
        format!("of body `{}` at {}", self.bodies[particle.body as usize].name, self.place(particle.position))
    }

    fn place(&self, point: DVec3) -> String {
        let numbers: Vec<String> = point.to_array()[..self.dimension].iter().map(|&x| rounded(x)).collect();
        format!("[{}]", numbers.join(", "))
    }
}

/// To six digits.
fn rounded(number: f64) -> String {
    format!("{number:.5e}").parse::<f64>().unwrap_or(number).to_string()
}
