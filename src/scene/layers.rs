//! How many layers of particles a body has through its thinnest part, and whether its formulation can bear so few.
//!
//! Where the neighbours of a particle lie on a line, or in space on a plane, no gradient across it can be found: the correction
//! of the kernel is singular, the program falls back to none, and a strip of one layer is hundreds of times too stiff.
//!
//! Layers are counted by the spread of a particle's neighbours across their thinnest direction: n layers a spacing apart have the
//! variance (n^2 - 1)/12. A particle on the surface of a thick body sees only half of what is around it, so the thickness there
//! is that of the neighbour with the largest.

use super::neighbors::{Grid, mirrored};
use super::shape::Shape;
use super::{Scene, SceneBody, words};
use crate::method::{Formulation, Gradient};
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Distance within which layers are counted, in spacings.
const REACH: f64 = 2.6;

/// Share of the particles within reach in the midst of a body above which there are more than three layers: these have 0.71 of
/// them in the plane, 0.78 in space.
const THICK: f64 = 0.82;

/// Layers of a shape from which on its particles are not looked at.
const MANY: f64 = 6.0;

/// The thinnest part of a body of few layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thin {
    /// Index of the body.
    pub body: usize,
    /// Layers through it, from 1 to about 3.
    pub layers: u32,
    /// m
    pub place: DVec3,
}

impl Scene {
    /// Bodies of at most two layers in a formulation that corrects its gradients, in a scene of one group; each copy of a body
    /// counts as itself, and the first of those alike is named.
    pub(super) fn thin_parts(&self) -> Vec<Thin> {
        let corrects = match self.method.formulation {
            Formulation::TotalLagrangian => self.method.gradient != Gradient::Plain,
            Formulation::CorrectedKernel => self.method.corrected_kernel.is_some_and(|options| options.correction),
            Formulation::Eulerian => false,
        };
        if !corrects || self.dimension() == 1 {
            return Vec::new();
        }
        let mut chosen: Vec<usize> = Vec::new();
        for (k, body) in self.bodies.iter().enumerate() {
            let known = chosen.iter().any(|&other| self.bodies[other].group == body.group);
            if !known && !self.surely_thick(k) {
                chosen.push(k);
            }
        }
        let reach = chosen.iter().map(|&k| REACH * self.bodies[k].spacing).fold(0.0, f64::max);
        if reach == 0.0 {
            return Vec::new();
        }
        let around = Around { scene: self, grid: Grid::new(self, reach) };
        let found = chosen.into_iter().filter_map(|k| around.thinnest(k));
        found.filter(|thin| thin.layers < 3).collect()
    }

    /// Whether a body's shape is plainly thick. A mirror plane only adds to it.
    fn surely_thick(&self, body: usize) -> bool {
        let thickness = self.file.body[body].shape.least_thickness(self.dimension());
        thickness.is_some_and(|thickness| thickness >= MANY * self.bodies[body].spacing)
    }

    /// What to tell of a part of two layers.
    pub(super) fn two_layers(&self, thin: &Thin) -> String {
        let body = &self.bodies[thin.body];
        let ratio = poisson_ratio(body);
        let locks = if ratio > 0.4 {
            format!("; at a Poisson ratio of {ratio:.2} so few lock, and bending comes out several times too stiff")
        } else {
            String::new()
        };
        let quadratic = if self.method.gradient == Gradient::Quadratic { ", too few for the quadratic gradient" } else { "" };
        format!(
            "`{}` is two layers of particles thin at {}{quadratic}: bending is off by about 10 %{locks}; take a spacing of {} or \
             less there for three",
            body.group,
            words::place(thin.place, self.dimension()),
            words::rounded(self.finer(thin), 3)
        )
    }

    /// Why a body of one layer is refused.
    pub(super) fn one_layer(&self, thin: &Thin) -> String {
        format!(
            "body `{}` is one layer of particles thin at {}: gradients across it cannot be corrected, and it would be hundreds of times \
             too stiff; it takes at least 3 layers, a spacing of {} or less",
            self.bodies[thin.body].name,
            words::place(thin.place, self.dimension()),
            words::rounded(self.finer(thin), 3)
        )
    }

    /// Spacing with three layers (m).
    fn finer(&self, thin: &Thin) -> f64 {
        let layers = f64::from(thin.layers) * self.bodies[thin.body].spacing;
        let shape = self.file.body[thin.body].shape.least_thickness(self.dimension());
        shape.unwrap_or(layers).min(layers) / 3.0
    }
}

/// Of the elastic moduli.
fn poisson_ratio(body: &SceneBody) -> f64 {
    let (bulk, shear) = (body.material.bulk_modulus, body.material.shear_modulus);
    (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
}

impl Shape {
    /// The least thickness of a shape (m) that has but one; none of polygons and combinations.
    fn least_thickness(&self, dimension: usize) -> Option<f64> {
        match self {
            Self::Block { min, max } => {
                let size = max.vector() - min.vector();
                Some((0..dimension).map(|axis| size[axis]).fold(f64::INFINITY, f64::min))
            }
            Self::Disc { radius, .. } | Self::Sphere { radius, .. } => Some(2.0 * radius),
            Self::Ring { inner, outer, .. } => Some(outer - inner),
            Self::Cylinder { radius, length, .. } => Some(length.min(2.0 * radius)),
            Self::Tube { inner, outer, length, .. } => Some(length.min(outer - inner)),
            Self::Polygon { .. } | Self::Union { .. } | Self::Cut { .. } | Self::Intersection { .. } => None,
        }
    }
}

/// The particles of a scene by place.
struct Around<'a> {
    scene: &'a Scene,
    grid: Grid,
}

impl Around<'_> {
    /// The part of a body with the fewest layers, unless it is thick everywhere.
    fn thinnest(&self, body: usize) -> Option<Thin> {
        let own: Vec<usize> =
            (0..self.scene.particles.len()).filter(|&i| self.scene.particles[i].body as usize == body).collect();
        let volume = own.iter().map(|&i| self.scene.particles[i].volume).sum::<f64>() * self.scene.bodies[body].relative_volume;
        let spacing = (volume / own.len() as f64).powf(1.0 / self.scene.dimension() as f64);
        let midst = if self.scene.dimension() == 2 { PI * REACH.powi(2) } else { 4.0 / 3.0 * PI * REACH.powi(3) };
        let reach = REACH * spacing;
        let mut thick = vec![false; self.scene.particles.len()];
        let counts: Vec<usize> = own.par_iter().map(|&i| self.ways(i, reach).len()).collect();
        own.iter().zip(&counts).for_each(|(&i, &count)| thick[i] = count as f64 > THICK * midst);
        // Of a particle that has a thick neighbour the surface is seen, and no thin part.
        let thin: Vec<usize> = own.into_par_iter().filter(|&i| !self.ways(i, reach).iter().any(|&(j, _)| thick[j])).collect();
        let layers = thin.par_iter().map(|&i| {
            let most = self.ways(i, reach).iter().map(|&(j, _)| self.layers(j, reach, spacing)).fold(1.0, f64::max);
            (most, i)
        });
        let (layers, i) = layers.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        Some(Thin { body, layers: layers.round() as u32, place: self.scene.particles[i].position })
    }

    /// The particles of a particle's own body within reach, itself and mirror images among them: index, and the way to them.
    fn ways(&self, i: usize, reach: f64) -> Vec<(usize, DVec3)> {
        let (scene, particle) = (self.scene, &self.scene.particles[i]);
        let (mut ways, joined) = (Vec::new(), scene.joined(i));
        for image in 0..1u32 << scene.planes.len() {
            let x = mirrored(&scene.planes, image, particle.position);
            self.grid.visit(scene, x, reach, |j, way| {
                if joined(scene.particles[j].body) {
                    ways.push((j, unmirrored(scene, image, way)));
                }
            });
        }
        ways
    }

    /// Layers from the spread of a particle's neighbours.
    fn layers(&self, i: usize, reach: f64, spacing: f64) -> f64 {
        let ways = self.ways(i, reach);
        let middle = ways.iter().map(|(_, way)| *way).sum::<DVec3>() / ways.len() as f64;
        let spread: DMat3 = ways.iter().map(|(_, way)| outer(*way - middle)).fold(DMat3::ZERO, |sum, part| sum + part);
        let variance = least_eigenvalue(spread * (1.0 / ways.len() as f64), self.scene.dimension());
        (1.0 + 12.0 * variance.max(0.0) / (spacing * spacing)).sqrt()
    }
}

/// A way seen from a mirrored point, turned back.
fn unmirrored(scene: &Scene, image: u32, way: DVec3) -> DVec3 {
    let planes = scene.planes.iter().enumerate().filter(|(k, _)| image >> k & 1 == 1);
    planes.fold(way, |way, (_, plane)| way - plane.normal * (2.0 * way.dot(plane.normal)))
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// The least eigenvalue of a symmetric matrix: O. K. Smith, Commun. ACM 4 (1961), 168.
fn least_eigenvalue(a: DMat3, dimension: usize) -> f64 {
    let (xx, yy, xy) = (a.x_axis.x, a.y_axis.y, a.y_axis.x);
    if dimension == 2 {
        return (xx + yy) / 2.0 - ((xx - yy) / 2.0).hypot(xy);
    }
    let mean = (xx + yy + a.z_axis.z) / 3.0;
    let deviator = a - DMat3::from_diagonal(DVec3::splat(mean));
    let square = |v: DVec3| v.length_squared();
    let size = ((square(deviator.x_axis) + square(deviator.y_axis) + square(deviator.z_axis)) / 6.0).sqrt();
    if size == 0.0 {
        return mean;
    }
    let angle = ((deviator * (1.0 / size)).determinant() / 2.0).clamp(-1.0, 1.0).acos() / 3.0;
    mean + 2.0 * size * (angle + TAU / 3.0).cos()
}
