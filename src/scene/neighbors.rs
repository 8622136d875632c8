//! How many neighbours a particle has in the reference configuration: the exact length of a neighbour list that is
//! made once.

use super::{Plane, Scene};
use glam::{DVec3, IVec3};
use rayon::prelude::*;
use std::collections::HashMap;

/// Factor on the reach: in f32, rounding may put a pair inside that lies exactly at the end of the reach in f64.
const ROUNDING: f64 = 1.0 + 1e-5;

impl Scene {
    /// Most particles of its own body and of those tied to it that any particle has within a distance, mirror images included.
    pub(super) fn most_neighbors(&self, reach: f64) -> u32 {
        let reach = reach * ROUNDING;
        let grid = Grid::new(self, reach);
        let count = |i: usize| {
            let x = self.particles[i].position;
            let images = (0..1u32 << self.planes.len()).map(|image| mirrored(&self.planes, image, x));
            images.map(|x| grid.count(self, x, self.joined(i), reach)).sum::<u32>() - 1
        };
        (0..self.particles.len()).into_par_iter().map(count).max().unwrap_or(0)
    }

    /// Bodies whose particles are bonded to one.
    pub(super) fn joined(&self, particle: usize) -> impl Fn(u32) -> bool {
        let (body, weights) = (self.particles[particle].body, &self.coupling[self.particles[particle].body as usize]);
        move |other| other == body || (self.method.tied && weights[other as usize] > 0.0)
    }

    /// The nearest particles of two bodies that `wanted` takes, given the lower number first, if any are nearer than
    /// `reach`; and their distance.
    pub(super) fn closest(&self, reach: f64, wanted: impl Fn(u32, u32) -> bool + Sync) -> Option<(f64, [usize; 2])> {
        let grid = Grid::new(self, reach);
        let near = |i: usize| {
            let own = self.particles[i].body;
            let mut best: Option<(f64, [usize; 2])> = None;
            grid.visit(self, self.particles[i].position, reach, |j, way| {
                let distance = way.length();
                let other = self.particles[j].body;
                let taken = own < other && wanted(own, other);
                if taken && best.is_none_or(|(least, _)| distance < least) {
                    best = Some((distance, [i, j]));
                }
            });
            best
        };
        (0..self.particles.len()).into_par_iter().filter_map(near).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
    }

    /// Most particles that one of any body has inside the support of its kernel, with none at the very end.
    pub(super) fn most_supported(&self) -> u32 {
        let reach = 2.0 * self.smoothing_length() / ROUNDING;
        let grid = Grid::new(self, reach);
        let count = |i: usize| {
            let particle = &self.particles[i];
            let own = 2.0 * self.bodies[particle.body as usize].smoothing_length / ROUNDING;
            grid.count(self, particle.position, self.joined(i), own) - 1
        };
        (0..self.particles.len()).into_par_iter().map(count).max().unwrap_or(0)
    }
}

pub(super) fn mirrored(planes: &[Plane], image: u32, mut x: DVec3) -> DVec3 {
    for (k, plane) in planes.iter().enumerate() {
        if image >> k & 1 == 1 {
            x -= plane.normal * (2.0 * (x.dot(plane.normal) - plane.offset));
        }
    }
    x
}

/// Particles by cells at least as wide as the reach.
pub(super) struct Grid {
    side: DVec3,
    /// Cells along each periodic axis, 0 where it is open.
    wrap: IVec3,
    period: DVec3,
    cells: HashMap<IVec3, Vec<u32>>,
}

impl Grid {
    pub fn new(scene: &Scene, reach: f64) -> Self {
        let period = DVec3::from_array(scene.period);
        let wrap = (period / reach).floor().as_ivec3();
        let divided = |k: usize| if wrap[k] > 0 { period[k] / f64::from(wrap[k]) } else { reach };
        let side = DVec3::new(divided(0), divided(1), divided(2));
        let mut grid = Self { side, wrap, period, cells: HashMap::new() };
        for (i, particle) in scene.particles.iter().enumerate() {
            let cell = grid.wrapped((particle.position / side).floor().as_ivec3());
            grid.cells.entry(cell).or_default().push(i as u32);
        }
        grid
    }

    fn wrapped(&self, cell: IVec3) -> IVec3 {
        let axis = |k: usize| if self.wrap[k] > 0 { cell[k].rem_euclid(self.wrap[k]) } else { cell[k] };
        IVec3::new(axis(0), axis(1), axis(2))
    }

    /// Particles of bodies within a distance, at most the grid's, of a point.
    fn count(&self, scene: &Scene, x: DVec3, of: impl Fn(u32) -> bool, reach: f64) -> u32 {
        let mut found = 0;
        self.visit(scene, x, reach, |i, _| found += u32::from(of(scene.particles[i].body)));
        found
    }

    /// Hands on the index of each particle within a distance, at most the grid's, of a point, and the way to it from there.
    pub fn visit(&self, scene: &Scene, x: DVec3, reach: f64, mut hand_on: impl FnMut(usize, DVec3)) {
        let center = (x / self.side).floor().as_ivec3();
        let range = |k: usize| if k < scene.dimension() { -1..=1 } else { 0..=0 };
        for dz in range(2) {
            for dy in range(1) {
                for dx in range(0) {
                    let cell = self.wrapped(center + IVec3::new(dx, dy, dz));
                    for &i in self.cells.get(&cell).into_iter().flatten() {
                        let way = self.way(x, scene.particles[i as usize].position);
                        if way.length() < reach {
                            hand_on(i as usize, way);
                        }
                    }
                }
            }
        }
    }

    /// From a to the nearest periodic image of b.
    fn way(&self, a: DVec3, b: DVec3) -> DVec3 {
        let apart = b - a;
        let axis = |k: usize| if self.period[k] > 0.0 { self.period[k] * (apart[k] / self.period[k]).round() } else { 0.0 };
        apart - DVec3::new(axis(0), axis(1), axis(2))
    }
}
