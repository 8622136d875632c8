//! A scene of several groups taken apart: each group as a scene of its own, and what is left between them.

use super::groups::{Group, across};
use super::{Particle, Scene, SceneFacet, SceneObstacle, contacts};
use crate::method::Method;
use crate::rows::{ContactPair, FacetPair};
use std::sync::OnceLock;

impl Scene {
    /// The group as a scene of its own, but for its method.
    pub(super) fn part(&self, group: &Group) -> Scene {
        let place = |body: u32| group.bodies.iter().position(|&own| own == body as usize);
        let own = self.particles.iter().enumerate().filter_map(|(number, particle)| {
            let body = place(particle.body)? as u32;
            Some((number as u32, Particle { body, ..*particle }))
        });
        let (numbers, particles): (Vec<u32>, Vec<Particle>) = own.unzip();
        let first_number = numbers.first().copied().unwrap_or(0);
        let facets: Vec<SceneFacet> =
            self.facets.iter().filter(|facet| numbers.binary_search(&facet.owner).is_ok()).copied().collect();
        let obstacles = self.obstacles.iter().map(|obstacle| SceneObstacle {
            pairs: group.bodies.iter().map(|&body| obstacle.pairs[body]).collect(),
            ..obstacle.clone()
        });
        let obstacles: Vec<SceneObstacle> =
            obstacles.filter(|obstacle| obstacle.pairs.iter().any(|pair| pair.stiffness > 0.0)).collect();
        let mut file = group.view(&self.file);
        file.obstacle.retain(|typed| obstacles.iter().any(|obstacle| obstacle.name == typed.name));
        Scene {
            file,
            bodies: group.bodies.iter().map(|&body| self.bodies[body].clone()).collect(),
            coupling: among(&self.coupling, group),
            contacts: among(&self.contacts, group),
            facet_pairs: among(&self.facet_pairs, group),
            obstacles,
            facets: facets.into_iter().map(|facet| SceneFacet { owner: facet.owner - first_number, ..facet }).collect(),
            particles,
            first_number,
            part_of: Some((group.bodies.clone(), self.bodies.len())),
            most_bonds: OnceLock::new(),
            ..self.clone()
        }
    }

    /// One line for each thing that a user should know of a scene of several groups: which there are, and which of them nothing
    /// acts between.
    pub fn grouping(&self) -> Vec<String> {
        let names = |part: &Scene| {
            let mut names: Vec<&str> = part.bodies.iter().map(|body| body.group.as_str()).collect();
            names.dedup();
            names.join(", ")
        };
        let mut lines = Vec::new();
        if !self.parts.is_empty() {
            let of = |part: &Scene| format!("{} ({})", names(part), part.method.formulation.word());
            lines.push(format!("groups of bodies: {}", self.parts.iter().map(of).collect::<Vec<_>>().join("; ")));
        }
        for (k, one) in self.parts.iter().enumerate() {
            for other in &self.parts[..k] {
                let bodies = |part: &Scene| part.part_of.as_ref().map_or_else(Vec::new, |(bodies, _)| bodies.clone());
                let others = bodies(other);
                let acts = |a: usize, b: usize| self.contacts[a][b].range > 0.0;
                let strange = |a: usize, b: usize| self.strangers.get(a).is_some_and(|row| row[b]);
                let some =
                    |holds: &dyn Fn(usize, usize) -> bool| bodies(one).into_iter().any(|a| others.iter().any(|&b| holds(a, b)));
                if !some(&acts) && some(&strange) {
                    lines.push(format!("nothing acts between {} and {}: they pass through each other", names(other), names(one)));
                }
            }
        }
        lines
    }

    /// The method of what acts between the groups.
    pub(super) fn method_between(&self, groups: &[Group]) -> Method {
        let mut file = self.file.clone();
        file.contact.retain(|contact| across(groups, &self.file, contact));
        let coloured = file.contact.iter().find(|contact| contact.colour_field.is_some());
        let of_contact = coloured.and_then(|contact| groups.iter().find(|group| group.has(&self.file, &contact.between[0])));
        Method {
            dimension: self.file.dimension,
            between: true,
            smoothing: of_contact.unwrap_or(&groups[0]).formulation.smoothing,
            integrator: self.file.time.integrator,
            laws: Vec::new(),
            many_bodies: true,
            contact: contacts::laws(&file),
            periodic: self.period.iter().any(|&length| length > 0.0),
            shear: false,
            ..Method::default()
        }
    }

    /// Takes what acts inside the groups out of the tables of the whole scene.
    pub(super) fn leave_to_parts(&mut self, groups: &[Group]) {
        for group in groups {
            for &a in &group.bodies {
                for &b in &group.bodies {
                    (self.contacts[a][b], self.facet_pairs[a][b]) = (ContactPair::default(), FacetPair::default());
                }
            }
        }
    }

    /// Facets that the member of the run has whose scene this is: none between groups.
    pub(super) fn own_facets(&self) -> &[SceneFacet] {
        if self.method.between { &[] } else { &self.facets }
    }

    pub(super) fn own_obstacles(&self) -> &[SceneObstacle] {
        if self.method.between { &[] } else { &self.obstacles }
    }

    /// Rows of the tables with one for each body.
    pub(super) fn numbered_bodies(&self) -> u32 {
        match &self.part_of {
            Some((bodies, count)) if bodies.len() > 1 => *count as u32,
            _ => self.bodies.len() as u32,
        }
    }

    /// A table with a row for each body as the passes index it: by the body's place in the whole scene, so that the members of a
    /// run know a body by one number. A part of one body has that one alone, and asks for no number.
    pub(super) fn by_body<T: Clone + Default>(&self, rows: &[T]) -> Vec<T> {
        match &self.part_of {
            Some((bodies, count)) if bodies.len() > 1 => {
                let mut table = vec![T::default(); *count];
                bodies.iter().zip(rows).for_each(|(&body, row)| table[body] = row.clone());
                table
            }
            _ => rows.to_vec(),
        }
    }

    /// The same for a table with a row for each pair of bodies.
    pub(super) fn by_pair<T: Clone + Default>(&self, table: &[Vec<T>]) -> Vec<T> {
        let rows: Vec<Vec<T>> = table.iter().map(|row| self.by_body(row)).collect();
        let width = rows.first().map_or(0, Vec::len);
        self.by_body(&rows).into_iter().flat_map(|row| if row.is_empty() { vec![T::default(); width] } else { row }).collect()
    }

    /// Index of a particle's body in those tables.
    pub(super) fn body_number(&self, particle: &Particle) -> u32 {
        self.part_of.as_ref().map_or(particle.body, |(bodies, _)| bodies[particle.body as usize] as u32)
    }
}

/// Rows and columns of the group's bodies.
fn among<T: Clone>(table: &[Vec<T>], group: &Group) -> Vec<Vec<T>> {
    group.bodies.iter().map(|&a| group.bodies.iter().map(|&b| table[a][b].clone()).collect()).collect()
}
