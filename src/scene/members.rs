//! What a scene is made of: bodies, particles and what acts on them.

use super::facets;
use super::material::Material;
use crate::rows::{BodyOptions, FacetPair, Obstacle};
use glam::DVec3;

/// A body's numbers.
#[derive(Debug, Clone)]
pub struct SceneBody {
    pub name: String,
    /// Name that the body shares with its copies, or its own name if it has none.
    pub group: String,
    pub spacing: f64,
    pub smoothing_length: f64,
    pub material: Material,
    /// What the formulation gives the body.
    pub options: BodyOptions<f64>,
    /// Volume over unstressed volume at the start.
    pub relative_volume: f64,
    /// Deviatoric stress at the start: xx, yy, zz, xy, yz, xz.
    pub deviator: [f64; 6],
}

/// A particle at the start.
#[derive(Debug, Clone, Copy)]
pub struct Particle {
    pub body: u32,
    /// Index of the boundary condition that holds the particle, plus 1; 0 if it is free.
    pub constraint: u32,
    pub position: DVec3,
    /// Volume when unstressed (area in 2D, length in 1D).
    pub volume: f64,
    pub velocity: DVec3,
}

/// A rigid obstacle.
#[derive(Debug, Clone)]
pub struct SceneObstacle {
    pub name: String,
    pub shape: Obstacle<f64>,
    /// Velocity at the start, or for the whole run where it is prescribed.
    pub velocity: DVec3,
    /// 1/mass; 0 for an obstacle whose motion is prescribed.
    pub inverse_mass: f64,
    /// Index of the constraint that prescribes the obstacle's velocity.
    pub condition: Option<usize>,
    /// How it touches each body.
    pub pairs: Vec<FacetPair<f64>>,
}

/// A piece of a body's surface, and the number of the particle that carries it.
#[derive(Debug, Clone, Copy)]
pub struct SceneFacet {
    pub owner: u32,
    pub piece: facets::Facet,
}

/// A boundary condition.
#[derive(Debug, Clone)]
pub struct SceneConstraint {
    pub name: String,
    /// Axes along which the velocity is prescribed.
    pub prescribed: [bool; 3],
    /// Velocity along those axes, acceleration along the others.
    pub vector: [f64; 3],
    pub course: Vec<[f64; 2]>,
}

impl SceneConstraint {
    /// The factor of the course, where it stays the same for the whole run.
    pub fn steady_factor(&self) -> Option<f64> {
        match self.course.first() {
            None => Some(1.0),
            Some(first) => self.course.iter().all(|point| point[1] == first[1]).then_some(first[1]),
        }
    }

    /// The factor of the course at a time; none without a course.
    pub fn factor(&self, time: f64) -> Option<f64> {
        (!self.course.is_empty()).then(|| factor(&self.course, time))
    }

    /// Whether a velocity other than zero is prescribed.
    pub fn drives(&self) -> bool {
        let moves = (0..3).any(|axis| self.prescribed[axis] && self.vector[axis] != 0.0);
        moves && self.steady_factor() != Some(0.0)
    }

    /// Whether a force acts that changes with time.
    pub fn pushes_unsteadily(&self) -> bool {
        (0..3).any(|axis| !self.prescribed[axis] && self.vector[axis] != 0.0) && self.steady_factor().is_none()
    }
}

/// The factor of a course at a time: linear between its points, constant outside.
pub(super) fn factor(course: &[[f64; 2]], time: f64) -> f64 {
    let after = course.partition_point(|point| point[0] <= time);
    match (after.checked_sub(1).map(|before| course[before]), course.get(after)) {
        (Some(a), Some(b)) => a[1] + (b[1] - a[1]) * (time - a[0]) / (b[0] - a[0]),
        (Some(end), None) => end[1],
        (None, first) => first.map_or(1.0, |point| point[1]),
    }
}

/// A mirror plane: points x with x . normal = offset.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    pub normal: DVec3,
    pub offset: f64,
}
