//! Contact by surfaces as typed, made into facets, obstacles and the numbers of their pairs.

use super::copies::{named, pairs};
use super::facets::{facets, owners};
use super::file::{self, ObstacleShape, SurfaceGap};
use super::groups::Group;
use super::refuse::Refuse;
use super::shape::{Coordinates, used};
use super::surface::{MOST_PIECES, pieces, to_a_cell};
use super::{Particle, Plane, SceneBody, SceneConstraint, SceneFacet, SceneObstacle};
use crate::facet::full_weight;
use crate::method::{Formulation, Gradient, Integrator};
use crate::obstacle::{BERKOVICH, ObstacleKind};
use crate::rows::{FacetPair, Obstacle};
use glam::DVec3;

/// What [`super::resolve`] has made so far.
pub(super) struct Parts<'a> {
    pub file: &'a file::File,
    pub bodies: &'a [SceneBody],
    pub particles: &'a [Particle],
    pub planes: &'a [Plane],
    pub groups: &'a [Group],
    pub coupling: &'a [Vec<f64>],
    pub refuse: &'a Refuse<'a>,
}

impl Parts<'_> {
    /// Pairs of bodies whose surfaces keep apart.
    pub fn gaps(&self) -> Result<Vec<Vec<FacetPair<f64>>>, String> {
        let bodies = self.bodies;
        let mut table = vec![vec![FacetPair::default(); bodies.len()]; bodies.len()];
        let parts = pieces(self.file, bodies);
        for (k, contact) in self.file.contact.iter().enumerate() {
            let Some(gap) = &contact.gap else { continue };
            let at = k.to_string();
            let path = ["contact", &at, "gap"];
            let touching = pairs(bodies, &contact.between);
            self.check_gap(gap, contact.touches(), &path)?;
            self.check_method(touching.iter().flat_map(|&(a, b)| [a, b]), &path)?;
            for (a, b) in touching {
                let spacing = bodies[a].spacing.max(bodies[b].spacing);
                let modulus = bodies[a].material.youngs_modulus().min(bodies[b].material.youngs_modulus());
                let seen_by = |other: usize| FacetPair {
                    // Each surface measures the other, so each has half the stiffness.
                    stiffness: 0.5 * gap.stiffness * modulus / spacing,
                    range: gap.range * spacing,
                    full: full_weight(gap.range, self.file.dimension) * to_a_cell(parts[other], self.file.dimension),
                    friction: gap.friction,
                };
                (table[a][b], table[b][a]) = (seen_by(b), seen_by(a));
            }
        }
        Ok(table)
    }

    fn check_gap(&self, gap: &SurfaceGap, potential: bool, path: &[&str; 3]) -> Result<(), String> {
        let refuse = self.refuse;
        refuse.unless(!potential, path, || "two bodies touch by one law: name a gap or another law, not both".into())?;
        refuse.unless(self.file.symmetry.is_empty() && self.file.periodic.is_none(), path, || {
            "contact by a gap sees neither mirror nor periodic images: take [[symmetry]] and periodic axes away".into()
        })?;
        let forms = self.file.contact.iter().filter_map(|contact| contact.gap.as_ref());
        refuse.unless(forms.into_iter().all(|other| other.form == gap.form), path, || {
            "all gaps of a scene share one form".into()
        })?;
        positive(refuse, path, "stiffness", gap.stiffness)?;
        refuse.unless(gap.range >= 1.0 && gap.range <= 4.0, &[path[0], path[1], path[2], "range"], || {
            format!("range must lie between 1 and 4 spacings, found {}", gap.range)
        })?;
        self.check_friction(gap.friction, path)
    }

    fn check_friction(&self, friction: f64, path: &[&str]) -> Result<(), String> {
        let refuse = self.refuse;
        refuse.unless(friction >= 0.0 && friction.is_finite(), path, || {
            format!("friction must be 0 or a positive number, found {friction}")
        })?;
        refuse.unless(friction == 0.0 || self.file.quasi_static.is_none(), path, || {
            "friction depends on the way that equilibrium is reached: a scene with [quasi_static] takes none".into()
        })
    }

    /// What contact by surfaces asks of the scene and of the bodies that touch.
    fn check_method(&self, bodies: impl Iterator<Item = usize> + Clone, path: &[&str]) -> Result<(), String> {
        let (file, refuse) = (self.file, self.refuse);
        let has_all = |group: &&Group| bodies.clone().all(|body| group.bodies.contains(&body));
        let Some(group) = self.groups.iter().find(has_all) else {
            return Err(refuse.at(
                path,
                "contact by surfaces is for bodies of one group, whose formulations differ in numbers alone: name a potential, or \
                 for an obstacle the bodies that it is `against`",
            ));
        };
        refuse.unless(group.kind() == Formulation::TotalLagrangian, path, || {
            "contact by surfaces needs formulation.kind `total_lagrangian`".into()
        })?;
        refuse.unless(group.formulation.gradient != Some(Gradient::Quadratic), path, || {
            "contact by surfaces does not go with the quadratic gradient".into()
        })?;
        refuse.unless(file.quasi_static.is_some() || file.time.integrator == Integrator::Leapfrog, path, || {
            "contact by surfaces needs time.integrator `leapfrog`, or [quasi_static]".into()
        })
    }

    /// Rigid obstacles; what moves them is added to the constraints.
    pub fn obstacles(&self, constraints: &mut Vec<SceneConstraint>) -> Result<Vec<SceneObstacle>, String> {
        let typed = self.file.obstacle.iter().enumerate();
        typed.map(|(k, typed)| self.obstacle(typed, &k.to_string(), constraints)).collect()
    }

    fn obstacle(
        &self,
        typed: &file::ObstacleTable,
        at: &str,
        constraints: &mut Vec<SceneConstraint>,
    ) -> Result<SceneObstacle, String> {
        let (refuse, path) = (self.refuse, ["obstacle", at]);
        let pairs = self.touched(typed, &path)?;
        self.check_method((0..pairs.len()).filter(|&k| self.meets(typed, k)), &path)?;
        self.check_friction(typed.friction, &path)?;
        positive(refuse, &path, "stiffness", typed.stiffness)?;
        if let Some(mass) = typed.mass {
            positive(refuse, &path, "mass", mass)?;
            refuse.unless(typed.course.is_none() && self.file.quasi_static.is_none(), &path, || {
                "an obstacle with a mass moves freely: it takes neither a course nor [quasi_static]".into()
            })?;
        }
        let dimension = self.file.dimension;
        let velocity = used(typed.velocity.as_ref().map_or(DVec3::ZERO, |v| v.vector()), dimension);
        let condition = (typed.mass.is_none() && velocity != DVec3::ZERO).then(|| {
            constraints.push(SceneConstraint {
                name: typed.name.clone(),
                prescribed: [true; 3],
                vector: velocity.to_array(),
                course: typed.course.clone().unwrap_or_default(),
            });
            constraints.len() - 1
        });
        Ok(SceneObstacle {
            name: typed.name.clone(),
            shape: self.shape(typed, velocity).map_err(|message| refuse.at(&["obstacle", at, "shape"], message))?,
            velocity,
            inverse_mass: typed.mass.map_or(0.0, |mass| 1.0 / mass),
            condition,
            pairs,
        })
    }

    fn shape(&self, typed: &file::ObstacleTable, velocity: DVec3) -> Result<Obstacle<f64>, String> {
        let vector = |c: &Coordinates| used(c.vector(), self.file.dimension);
        let solid = self.file.dimension == 3;
        let round = |center: DVec3, radius: f64, kind, along: DVec3| {
            if !(radius > 0.0 && radius.is_finite()) {
                return Err(format!("radius must be a positive number, found {radius}"));
            }
            // The axis leads from the point that touches first to the centre.
            let inward = -self.toward_bodies(center, along, velocity);
            Ok(Obstacle::new(kind, center - inward * radius, [inward, along], radius, 0.0))
        };
        let pointed = |apex: DVec3, axis: DVec3, kind, turn: DVec3, angle: f64| {
            if axis == DVec3::ZERO {
                return Err("axis must not be zero".into());
            }
            if !(angle > 0.0 && angle < 90.0) {
                return Err(format!("half_angle must lie between 0 and 90 degrees, found {angle}"));
            }
            Ok(Obstacle::new(kind, apex, [axis, turn], 0.0, angle))
        };
        match &typed.shape {
            ObstacleShape::Plane { point, normal } if vector(normal) != DVec3::ZERO => {
                Ok(Obstacle::new(ObstacleKind::Plane, vector(point), [vector(normal), DVec3::ZERO], 0.0, 0.0))
            }
            ObstacleShape::Plane { .. } => Err("normal must not be zero".into()),
            ObstacleShape::Sphere { center, radius } => round(vector(center), *radius, ObstacleKind::Sphere, DVec3::ZERO),
            ObstacleShape::Cylinder { .. } | ObstacleShape::Berkovich { .. } if !solid => {
                Err("a cylinder or a Berkovich pyramid needs dimension 3".into())
            }
            ObstacleShape::Cylinder { center, axis, radius } => match vector(axis).try_normalize() {
                Some(along) => round(vector(center), *radius, ObstacleKind::Cylinder, along),
                None => Err("axis must not be zero".into()),
            },
            ObstacleShape::Cone { apex, axis, half_angle } => {
                pointed(vector(apex), vector(axis), ObstacleKind::Cone, DVec3::ZERO, *half_angle)
            }
            ObstacleShape::Berkovich { apex, axis, turn } => {
                let across = vector(axis).any_orthogonal_vector();
                let about = vector(axis).normalize_or_zero();
                let turned = glam::DQuat::from_axis_angle(about, turn.to_radians()) * across;
                pointed(vector(apex), vector(axis), ObstacleKind::Berkovich, turned, BERKOVICH)
            }
        }
    }

    /// Direction in which a round obstacle touches first: that of its velocity, or of the nearest particle.
    fn toward_bodies(&self, center: DVec3, along: DVec3, velocity: DVec3) -> DVec3 {
        let across = |v: DVec3| (v - along * v.dot(along)).try_normalize();
        let distance = |p: &&Particle| p.position.distance_squared(center);
        let nearest = || self.particles.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        across(velocity).or_else(|| across(nearest()?.position - center)).unwrap_or(-DVec3::Y)
    }

    /// How an obstacle touches each body.
    fn touched(&self, typed: &file::ObstacleTable, path: &[&str; 2]) -> Result<Vec<FacetPair<f64>>, String> {
        let known = |word: &String| !named(self.bodies, word).is_empty();
        if let Some(stray) = typed.against.iter().flatten().find(|word| !known(word)) {
            return Err(self.refuse.at(&[path[0], path[1], "against"], format!("no body is named `{stray}`")));
        }
        let pair = |(k, body): (usize, &SceneBody)| {
            let stiffness =
                if self.meets(typed, k) { typed.stiffness * body.material.youngs_modulus() / body.spacing } else { 0.0 };
            FacetPair { stiffness, friction: typed.friction, ..FacetPair::default() }
        };
        Ok(self.bodies.iter().enumerate().map(pair).collect())
    }

    /// Whether an obstacle is in the way of a body.
    fn meets(&self, typed: &file::ObstacleTable, body: usize) -> bool {
        let body = &self.bodies[body];
        typed.against.as_ref().is_none_or(|list| list.iter().any(|word| *word == body.name || *word == body.group))
    }

    /// Facets of the bodies that touch something, in order of their owners; none on mirror planes, nor where a tied body goes on.
    pub fn facets(&self, gaps: &[Vec<FacetPair<f64>>], obstacles: &[SceneObstacle]) -> Result<Vec<SceneFacet>, String> {
        let parts = pieces(self.file, self.bodies);
        let mut list = Vec::new();
        for (k, (typed, body)) in self.file.body.iter().zip(self.bodies).enumerate() {
            let touches = gaps[k].iter().chain(obstacles.iter().map(|o| &o.pairs[k])).any(|pair| pair.stiffness > 0.0);
            if !touches {
                continue;
            }
            let parts = parts[k];
            let path = ["body", &k.to_string(), "facets"];
            self.refuse.unless((1..=MOST_PIECES).contains(&parts), &path, || {
                format!("facets must lie between 1 and {MOST_PIECES}, found {parts}")
            })?;
            let side = body.spacing / f64::from(parts);
            // The cells of the smaller facets part those of the lattice.
            let anchor = typed.lattice_anchor(body.spacing, self.file.dimension)
                + used(DVec3::splat(0.5 * (side - body.spacing)), self.file.dimension);
            let mut pieces = facets(&typed.shape, side, anchor, self.file.dimension);
            pieces.retain(|piece| !self.planes.iter().any(|plane| mirrored(plane, piece, body.spacing)));
            let tied = super::ties::of(self.coupling, k).map(|other| &self.file.body[other].shape).collect::<Vec<_>>();
            pieces.retain(|piece| {
                let beyond = piece.position + 0.5 * body.spacing * piece.normal;
                !tied.iter().any(|shape| shape.distance(beyond, self.file.dimension) < 0.0)
            });
            let own = self.particles.iter().enumerate().filter(|(_, p)| p.body as usize == k);
            // A particle that lies deeper than this carries no facet.
            let deep = -2.0 * body.spacing;
            let own = own.filter(|(_, p)| typed.shape.distance(p.position, self.file.dimension) > deep);
            let (numbers, positions): (Vec<u32>, Vec<DVec3>) = own.map(|(i, p)| (i as u32, p.position)).unzip();
            let owners = owners(&pieces, &positions, body.spacing);
            list.extend(pieces.iter().zip(owners).map(|(&piece, owner)| SceneFacet { owner: numbers[owner as usize], piece }));
        }
        list.sort_by_key(|facet: &SceneFacet| facet.owner);
        Ok(list)
    }
}

/// Whether a facet lies on a mirror plane: the body goes on behind it.
fn mirrored(plane: &Plane, piece: &super::facets::Facet, spacing: f64) -> bool {
    let away = plane.normal.dot(piece.position) - plane.offset;
    away.abs() < 0.25 * spacing && plane.normal.dot(piece.normal) < -0.99
}

fn positive(refuse: &Refuse, path: &[&str], key: &str, value: f64) -> Result<(), String> {
    let path: Vec<&str> = path.iter().copied().chain([key]).collect();
    refuse.unless(value > 0.0 && value.is_finite(), &path, || format!("{key} must be a positive number, found {value}"))
}
