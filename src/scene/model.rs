//! A scene as it runs.

use super::members::{Particle, Plane, SceneBody, SceneConstraint, SceneFacet, SceneObstacle};
use super::near::Near;
use super::read::Source;
use super::{copies, file, shape};
use crate::fields::Field;
use crate::method::Method;
use crate::rows::{ContactPair, FacetPair};
use crate::step;
use glam::DVec3;
use std::collections::BTreeSet;
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
    /// Where each value was typed.
    pub source: Source,
    /// The method of all bodies; or, where the scene has [`Self::parts`], that of what acts between them.
    pub method: Method,
    /// The groups of bodies that step apart from each other, each as a scene of its own; empty where all bodies are one group.
    pub parts: Vec<Scene>,
    /// Of a part: number in the whole scene of its first particle. The others follow.
    pub first_number: u32,
    /// Of a part: index in the whole scene of each of its bodies, and how many bodies that has. None in a whole scene.
    pub part_of: Option<(Vec<usize>, usize)>,
    pub bodies: Vec<SceneBody>,
    /// Weight of the kernel sums between bodies a and b.
    pub coupling: Vec<Vec<f64>>,
    /// How bodies a and b touch.
    pub contacts: Vec<Vec<ContactPair<f64>>>,
    /// How the surfaces of bodies a and b touch.
    pub facet_pairs: Vec<Vec<FacetPair<f64>>>,
    /// Whether bodies a and b have no law between them and the scene does not say that this is meant; empty where no bodies do.
    pub strangers: Vec<Vec<bool>>,
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
    /// What the run says before it starts: see [`super::warn`].
    pub warnings: Vec<String>,
    /// Most neighbours of a particle in the reference configuration, found when first asked for.
    pub(crate) most_bonds: OnceLock<u32>,
}

impl Scene {
    pub fn dimension(&self) -> usize {
        self.method.dimension
    }

    /// The groups of bodies that step apart from each other: most often the scene itself.
    pub fn groups(&self) -> &[Scene] {
        if self.parts.is_empty() { std::slice::from_ref(self) } else { &self.parts }
    }

    /// What a run steps: the groups and, where there are several, what acts between them.
    pub fn members(&self) -> impl Iterator<Item = &Scene> {
        self.groups().iter().chain((!self.parts.is_empty()).then_some(self))
    }

    pub fn methods(&self) -> Vec<Method> {
        self.members().map(|member| member.method.clone()).collect()
    }

    /// The group of a particle.
    pub fn group_of(&self, number: usize) -> &Scene {
        let after = self.groups().partition_point(|group| group.first_number as usize <= number);
        &self.groups()[after - 1]
    }

    /// Fields that some member has, in the order of their list.
    pub fn fields(&self) -> Vec<Field> {
        let needed: BTreeSet<Field> = self.members().flat_map(|member| step::fields(&member.method)).collect();
        needed.into_iter().collect()
    }

    /// Refuses a scene whose bodies differ in their formulation, where only one is understood.
    ///
    /// # Errors
    /// One sentence that begins with the place of the formulations.
    pub fn one_formulation(&self, what: &str) -> Result<(), String> {
        if self.parts.is_empty() && !self.method.body_options {
            return Ok(());
        }
        let place = self.place(&["formulation"]);
        Err(format!("{place}: {what} takes a scene whose bodies have one formulation, and this one has several"))
    }

    /// "scenes/rings.toml:12" of the value at a path of keys and indices, as they were typed: see [`Source::place`].
    pub fn place(&self, path: &[&str]) -> String {
        self.source.place(path)
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
        particle.volume * self.bodies[particle.body as usize].material.density
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

    /// Number of the particle nearest to a point at the start, of those that [`Self::select`] leaves.
    ///
    /// # Errors
    /// Where the point lies outside of them: how far, and where the nearest one is.
    pub fn nearest(&self, point: DVec3, body: Option<&str>, inside: Option<&shape::Shape>) -> Result<usize, String> {
        let selected = self.select(body, inside);
        self.near().point(point, |i| selected.binary_search(&i).is_ok())
    }

    /// That [`Self::select`] leaves no particle, and where the nearest one is.
    pub fn selects_none(&self, body: Option<&str>, inside: Option<&shape::Shape>) -> String {
        let of_body = self.select(body, None);
        self.near().none_in(inside, |i| of_body.binary_search(&i).is_ok())
    }

    fn near(&self) -> Near<'_> {
        Near { bodies: &self.bodies, particles: &self.particles, dimension: self.dimension() }
    }
}
