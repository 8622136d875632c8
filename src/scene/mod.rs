//! Scenes: as typed ([`file`]), then resolved here into particles and numbers. Knows no device.

mod carve;
mod check;
mod clip;
pub mod contacts;
mod copies;
pub mod corrected_kernel;
mod cost;
pub mod facets;
pub mod file;
mod motion;
mod neighbors;
pub mod packing;
mod plasticity;
mod quasi_static;
pub mod read;
mod resolve;
mod section;
pub mod shape;
mod state;
pub mod study;
mod surfaces;
mod words;

use crate::material::Law;
use crate::method::Method;
use crate::rows::{ContactPair, FacetPair, Obstacle};
use glam::DVec3;
use std::path::Path;
use std::sync::OnceLock;

/// A scene ready to run.
#[derive(Debug, Clone)]
pub struct Scene {
    /// File stem.
    pub name: String,
    pub variant: Option<String>,
    pub file: file::File,
    /// What is stored as `run.toml`.
    pub text: String,
    pub method: Method,
    pub bodies: Vec<SceneBody>,
    /// Weight of the kernel sums between bodies a and b.
    pub coupling: Vec<Vec<f64>>,
    /// How bodies a and b touch.
    pub contacts: Vec<Vec<ContactPair<f64>>>,
    /// How the surfaces of bodies a and b touch.
    pub facet_pairs: Vec<Vec<FacetPair<f64>>>,
    pub obstacles: Vec<SceneObstacle>,
    /// In order of the numbers of the particles that carry them; none where nothing touches by surfaces.
    pub facets: Vec<SceneFacet>,
    pub constraints: Vec<SceneConstraint>,
    /// In order of their numbers.
    pub particles: Vec<Particle>,
    /// Period of each axis, 0 where open.
    pub period: [f64; 3],
    pub planes: Vec<Plane>,
    /// Spacing at which the artificial stress has its nominal strength.
    pub artificial_spacing: f64,
    /// Most neighbours of a particle in the reference configuration, found when first asked for.
    pub(crate) most_bonds: OnceLock<u32>,
}

/// A body's numbers.
#[derive(Debug, Clone)]
pub struct SceneBody {
    pub name: String,
    /// Name that it shares with its copies, or its own.
    pub group: String,
    pub spacing: f64,
    pub smoothing_length: f64,
    pub density: f64,
    pub law: Law,
    pub bulk_modulus: f64,
    pub shear_modulus: f64,
    /// Shear modulus over viscosity of a Maxwell body, else 0.
    pub relaxation: f64,
    /// Yield stress of a J2 body, and its hardening's coefficient and exponent; else 0, 0 and 1.
    pub yield_stress: f64,
    pub hardening: [f64; 2],
    /// Volume over unstressed volume at the start.
    pub relative_volume: f64,
    /// Deviatoric stress at the start: xx, yy, zz, xy, yz, xz.
    pub deviator: [f64; 6],
}

impl SceneBody {
    pub fn youngs_modulus(&self) -> f64 {
        9.0 * self.bulk_modulus * self.shear_modulus / (3.0 * self.bulk_modulus + self.shear_modulus)
    }

    /// Speed of longitudinal waves.
    pub fn sound_speed(&self) -> f64 {
        ((self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus) / self.density).sqrt()
    }
}

/// A particle at the start.
#[derive(Debug, Clone, Copy)]
pub struct Particle {
    pub body: u32,
    /// Boundary condition plus 1, or 0.
    pub constraint: u32,
    pub position: DVec3,
    /// Unstressed.
    pub volume: f64,
    pub velocity: DVec3,
}

/// A rigid obstacle.
#[derive(Debug, Clone)]
pub struct SceneObstacle {
    pub name: String,
    pub shape: Obstacle<f64>,
    /// At the start, or throughout where it is prescribed.
    pub velocity: DVec3,
    /// 0 where the motion is prescribed.
    pub inverse_mass: f64,
    /// Index among the constraints of what prescribes its velocity.
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

/// A mirror plane: points x with x . normal = offset.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    pub normal: DVec3,
    pub offset: f64,
}

impl Scene {
    /// Reads and resolves a scene file. Errors are one sentence with file and line.
    pub fn open(path: &Path, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        Self::open_text(&read::text_of(path)?, path, variant, overrides)
    }

    /// The same from a text that was read from the file before.
    pub fn open_text(text: &str, path: &Path, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        let name = path.file_stem().map_or_else(|| "scene".into(), |s| s.to_string_lossy().into_owned());
        resolve::resolve(name, read::read_text(text, &path.display().to_string(), variant, overrides)?)
    }

    /// The same from text.
    pub fn parse(text: &str, name: &str, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        resolve::resolve(name.into(), read::read_text(text, name, variant, overrides)?)
    }

    /// [`Self::open`] without the flaws of the bodies' shapes.
    pub fn open_flawless(path: &Path, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        let name = path.file_stem().map_or_else(|| "scene".into(), |s| s.to_string_lossy().into_owned());
        resolve::resolve(name, read::read(path, variant, overrides)?.flawless())
    }

    pub fn dimension(&self) -> usize {
        self.method.dimension
    }

    /// Names of the units of length, mass and time.
    pub fn unit_names(&self) -> [&'static str; 3] {
        match self.file.units {
            file::Units::Si => ["m", "kg", "s"],
            file::Units::MillimetreTonneSecond => ["mm", "t", "s"],
            file::Units::Dimensionless => ["L", "M", "T"],
        }
    }

    /// Constant mass of a particle.
    pub fn mass(&self, number: usize) -> f64 {
        let particle = &self.particles[number];
        particle.volume * self.bodies[particle.body as usize].density
    }

    /// Index of the body, or of the first copy, of that name.
    pub fn body_index(&self, name: &str) -> Option<usize> {
        copies::named(&self.bodies, name).first().copied()
    }

    /// Scene and variant as one word, for folders and captions.
    pub fn label(&self) -> String {
        self.variant.as_ref().map_or_else(|| self.name.clone(), |variant| format!("{}-{variant}", self.name))
    }

    /// Numbers of the particles of a body or of all copies of it, inside a shape at the start, or both.
    pub fn select(&self, body: Option<&str>, inside: Option<&shape::Shape>) -> Vec<usize> {
        let wanted = body.map(|name| copies::named(&self.bodies, name));
        (0..self.particles.len())
            .filter(|&i| {
                let particle = &self.particles[i];
                wanted.as_ref().is_none_or(|list| list.binary_search(&(particle.body as usize)).is_ok())
                    && inside.is_none_or(|shape| shape.contains(particle.position, self.dimension()))
            })
            .collect()
    }

    /// Number of the particle nearest to a point at the start.
    pub fn nearest(&self, point: DVec3) -> usize {
        let distance = |i: &usize| self.particles[*i].position.distance_squared(point);
        (0..self.particles.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    }
}
