//! Whether forces balance at the load steps of a scene that seeks equilibrium.
//!
//! Inner forces cancel, so what supports, obstacles and loads do to the bodies sums to zero in equilibrium. The descent ends
//! where the largest out-of-balance force of a particle is small, and many small ones of one sign may still add up: by their
//! sum the forces on supports and obstacles miss each other, and an engineer would read either.

use crate::fields::Field;
use crate::observable::Moment;
use crate::scene::Scene;
use glam::DVec3;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Imbalance over the largest force at which a run says so, and how many times as large one must be for it to say so again.
const NOTED: f64 = 0.01;
const AGAIN: f64 = 10.0;

/// What a run keeps of its balance of forces.
#[derive(Debug, Clone, Default)]
pub struct Balance {
    /// The largest force that an end, an obstacle or a body bore so far.
    largest: f64,
    /// Imbalance of the load step where it was the largest share of the forces.
    worst: Option<Imbalance>,
    /// The imbalance of which the run spoke last.
    noted: f64,
}

/// By what forces miss each other at a load step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Imbalance {
    pub load_step: usize,
    pub force: f64,
    /// Largest force of the run up to there.
    pub of: f64,
    /// Body whose forces sum to it; none for the whole scene.
    pub body: Option<usize>,
}

impl Imbalance {
    pub fn share(&self) -> f64 {
        if self.of > 0.0 { self.force / self.of } else { 0.0 }
    }
}

/// Fields that are read where a scene seeks equilibrium.
pub fn fields(scene: &Scene) -> Vec<Field> {
    let present = scene.fields();
    [Field::Acceleration, Field::ObstacleForce].into_iter().filter(|field| present.contains(field)).collect()
}

/// Force on a particle that nothing bears: that of bonds, contacts and loads along the axes that are free.
pub fn unbalanced(moment: &Moment, i: usize) -> DVec3 {
    loads(moment, i).1
}

/// What holds a particle, and what holds it not: force of the support on it, and force out of balance; and the load on it.
fn loads(moment: &Moment, i: usize) -> (DVec3, DVec3, DVec3) {
    let (scene, part) = (moment.scene, moment.time / moment.scene.file.duration);
    let mass = scene.mass(i);
    let inner = moment.vector(Field::Acceleration, i);
    let pull = scene.file.body_force.as_deref().unwrap_or_default();
    let held = (scene.particles[i].constraint as usize).checked_sub(1).map(|k| &scene.constraints[k]);
    let (mut support, mut rest, mut load) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
    for axis in 0..scene.dimension() {
        let mut own = pull.get(axis).copied().unwrap_or(0.0) * part;
        let fixed = held.is_some_and(|condition| condition.prescribed[axis]);
        if let Some(condition) = held.filter(|_| !fixed) {
            own += condition.vector[axis] * condition.factor(moment.time).unwrap_or(part);
        }
        let sum = mass * (inner[axis] + own);
        load[axis] = mass * own;
        if fixed { support[axis] = -sum } else { rest[axis] = sum }
    }
    (support, rest, load)
}

impl Balance {
    /// Looks at the forces of a load step in equilibrium; gives a warning where they are out of balance, and again where they
    /// are by much more.
    pub fn look(&mut self, moment: &Moment, load_step: usize) -> Option<String> {
        let scene = moment.scene;
        let mut borne: BTreeMap<u32, DVec3> = BTreeMap::new();
        let (mut load, mut rests) = (DVec3::ZERO, vec![DVec3::ZERO; scene.bodies.len()]);
        for i in 0..moment.count() {
            let particle = &scene.particles[i];
            let (support, rest, own) = loads(moment, i);
            *borne.entry(particle.constraint).or_default() += support;
            rests[particle.body as usize] += rest;
            load += own;
        }
        let obstacles = (0..scene.obstacles.len()).map(|k| DVec3::from_array(moment.vector(Field::ObstacleForce, k)));
        let forces = borne.values().copied().chain(obstacles).chain([load]);
        self.largest = forces.map(DVec3::length).fold(self.largest, f64::max);
        let whole = (None, rests.iter().sum::<DVec3>().length());
        let each = rests.iter().enumerate().map(|(body, rest)| (Some(body), rest.length()));
        let (body, force) = each.fold(whole, |most, one| if one.1 > most.1 * (1.0 + 1e-9) { one } else { most });
        let seen = Imbalance { load_step, force, of: self.largest, body };
        if self.worst.is_none_or(|worst| seen.share() > worst.share()) {
            self.worst = Some(seen);
        }
        if seen.share() <= NOTED.max(AGAIN * self.noted) {
            return None;
        }
        self.noted = seen.share();
        Some(sentence(scene, &seen))
    }

    /// Numbers for a checkpoint.
    pub fn save(&self) -> Vec<f64> {
        let mut numbers = vec![self.largest, self.noted];
        if let Some(Imbalance { load_step, force, of, body }) = self.worst {
            numbers.extend([load_step as f64, force, of, body.map_or(-1.0, |body| body as f64)]);
        }
        numbers
    }

    /// Goes on from the numbers of a checkpoint.
    pub fn load(numbers: &[f64]) -> Self {
        let worst = match numbers {
            &[_, _, load_step, force, of, body] => {
                Some(Imbalance { load_step: load_step as usize, force, of, body: (body >= 0.0).then_some(body as usize) })
            }
            _ => None,
        };
        let number = |k: usize| numbers.get(k).copied().unwrap_or(0.0);
        Self { largest: number(0), noted: number(1), worst }
    }

    pub fn report(&self, scene: &Scene) -> Option<Report> {
        let worst = self.worst?;
        let share = worst.share();
        let text = match share > NOTED {
            true => format!("at worst {}", sentence(scene, &worst)),
            false => format!("forces balance to {share:.1e} of the largest one, at worst at load step {}", worst.load_step),
        };
        Some(Report { text, worst })
    }
}

/// What is told of the balance at the end of a run.
#[derive(Debug, Clone)]
pub struct Report {
    /// One line.
    pub text: String,
    pub worst: Imbalance,
}

impl Report {
    pub fn json(&self) -> Value {
        let worst = &self.worst;
        json!({ "imbalance": worst.share(), "force": worst.force, "of": worst.of, "load_step": worst.load_step })
    }
}

fn sentence(scene: &Scene, seen: &Imbalance) -> String {
    let residual = scene.file.quasi_static.as_ref().map_or(0.0, |typed| typed.residual);
    let on = seen.body.map_or_else(String::new, |body| format!(" on body `{}`", scene.bodies[body].name));
    format!(
        "forces are out of balance{on} by {:.3e} at load step {}, {:.1} % of the largest force of the run so far ({:.3e}): those on \
         supports and obstacles differ by as much; lower quasi_static.residual from {residual:e} to {:e}",
        seen.force,
        seen.load_step,
        100.0 * seen.share(),
        seen.of,
        // The imbalance falls with the residual.
        10f64.powf((residual * 0.5 * NOTED / seen.share()).log10().floor())
    )
}
