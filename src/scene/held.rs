//! Few layers between the held faces of a body that yields.

use super::{Scene, words};
use glam::DVec3;

/// Layers between two held faces from which on what the layers beside the faces do is no longer most of the answer. With ten of
/// them, and hardening of a hundredth of Young's modulus, the middle strains 1.7 times as much as it should.
const ENOUGH: f64 = 20.0;

impl Scene {
    /// One sentence for each pair of boundary conditions that hold a yielding body a few layers apart, with the body's index.
    pub(super) fn held_warnings(&self) -> Vec<(usize, String)> {
        let bodies = (0..self.bodies.len()).filter(|&k| self.bodies[k].material.yields());
        bodies.flat_map(|k| self.held_ends(k).into_iter().map(move |line| (k, line))).collect()
    }

    fn held_ends(&self, body: usize) -> Vec<String> {
        let count = self.constraints.len();
        let faces: Vec<Vec<DVec3>> = (0..count).map(|constraint| self.held(body, constraint)).collect();
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
        let (name, spacing) = (&self.bodies[body].name, self.bodies[body].spacing);
        let sentence = |(a, b): (usize, usize)| {
            let layers = (self.between([a, b], &faces)? / spacing).round() - 1.0;
            (1.0..ENOUGH).contains(&layers).then(|| {
                format!(
                    "only {layers:.0} layers of `{name}`, which yields, lie between the held faces `{}` and `{}`: layers beside a held \
                     face act up to 1.5 times too strong, so that the load comes out too high and plastic strain gathers in the \
                     middle; take a spacing of {} or less for {ENOUGH} layers",
                    self.constraints[a].name,
                    self.constraints[b].name,
                    words::rounded(spacing * (layers + 1.0) / (ENOUGH + 1.0), 3)
                )
            })
        };
        pairs.filter_map(sentence).collect()
    }

    /// Places (m) of a body's particles whose velocity a boundary condition prescribes.
    fn held(&self, body: usize, constraint: usize) -> Vec<DVec3> {
        if !self.constraints[constraint].prescribed.contains(&true) {
            return Vec::new();
        }
        let own = self.particles.iter().filter(|p| p.body as usize == body && p.constraint as usize == constraint + 1);
        own.map(|particle| particle.position).collect()
    }

    /// Distance (m) between two of the sets of held particles if a slab lies between them across which both are held and in
    /// which nothing is: not where they meet at a corner, where one holds along an axis that the other leaves free, or where
    /// each layer is held on its own.
    fn between(&self, [a, b]: [usize; 2], faces: &[Vec<DVec3>]) -> Option<f64> {
        if faces[a].is_empty() || faces[b].is_empty() {
            return None;
        }
        let middle = |face: &[DVec3]| face.iter().sum::<DVec3>() / face.len() as f64;
        let across = (middle(&faces[b]) - middle(&faces[a])).normalize_or_zero();
        let axis = across.abs().max_position();
        if !(self.constraints[a].prescribed[axis] && self.constraints[b].prescribed[axis]) {
            return None;
        }
        let low = faces[a].iter().map(|point| point.dot(across)).fold(f64::NEG_INFINITY, f64::max);
        let high = faces[b].iter().map(|point| point.dot(across)).fold(f64::INFINITY, f64::min);
        let held =
            |face: &Vec<DVec3>| face.iter().any(|point| (low..high).contains(&point.dot(across)) && point.dot(across) > low);
        (high > low && !faces.iter().any(held)).then_some(high - low)
    }
}
