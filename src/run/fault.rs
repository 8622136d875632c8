//! Where a run went wrong: the device tells only the kind of a fault, and the host finds the particle in the state that it left.

use super::balance;
use crate::fields::Field;
use crate::observable::Moment;
use crate::rows::{Clock, Fault};
use crate::scene::Scene;
use std::cmp::Reverse;

/// Fields in which a fault is looked for, of those that the scene has.
pub fn fields(scene: &Scene) -> Vec<Field> {
    let present = scene.fields();
    let mut list = vec![
        Field::Number,
        Field::Displacement,
        Field::Velocity,
        Field::Acceleration,
        Field::VolumetricStrain,
        Field::DisplacementGradient,
        Field::NeighborCount,
    ];
    list.retain(|field| present.contains(field));
    list
}

/// The particle at fault, and what it is at fault for.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    pub particle: usize,
    /// How many particles have the same fault.
    pub alike: usize,
    pub what: String,
}

impl Place {
    /// Body, number and place of the particle: where it is now or, where that is no number, where it was packed.
    pub fn sentence(&self, moment: &Moment) -> String {
        let (scene, particle) = (moment.scene, &moment.scene.particles[self.particle]);
        let now = moment.position(self.particle);
        let gone = now.iter().any(|x| !x.is_finite());
        let (at, word) = if gone { (particle.position.to_array(), "packed at") } else { (now, "at") };
        let coordinates: Vec<String> = at[..scene.dimension()].iter().map(|x| format!("{x:.4e}")).collect();
        let unit = match scene.unit_names()[0] {
            "L" => "",
            length => &format!(" {length}"),
        };
        let others = if self.alike > 1 { format!(", one of {} such", self.alike) } else { String::new() };
        format!(
            "body `{}`, particle {} {word} ({}){unit}{others}, {}",
            scene.bodies[particle.body as usize].name,
            self.particle,
            coordinates.join(", "),
            self.what
        )
    }
}

/// Finds the particle. None where no particle of the state shows the fault.
pub fn find(moment: &Moment, fault: Fault) -> Option<Place> {
    match fault {
        Fault::NotFinite => not_finite(moment),
        Fault::Inverted => inverted(moment),
        Fault::ListFull => crowded(moment),
        Fault::NoEquilibrium => pulled(moment),
    }
}

/// The particle of which most is no number. A fault spreads to neighbours within a step; what has spread least lies inside.
fn not_finite(moment: &Moment) -> Option<Place> {
    let named = [("displacement", Field::Displacement), ("velocity", Field::Velocity), ("acceleration", Field::Acceleration)];
    let wild = |i: usize| -> Vec<&str> {
        let vectors = named.iter().filter(|(_, field)| moment.vector(*field, i).iter().any(|x| !x.is_finite()));
        let mut list: Vec<&str> = vectors.map(|(word, _)| *word).collect();
        if !moment.volumetric_strain(i).is_finite() {
            list.push("deformation");
        }
        list
    };
    let all: Vec<(usize, Vec<&str>)> = (0..moment.count()).map(|i| (i, wild(i))).filter(|(_, list)| !list.is_empty()).collect();
    let Some((particle, list)) = all.iter().max_by_key(|(i, list)| (list.len(), Reverse(*i))) else {
        return fastest(moment);
    };
    Some(Place { particle: *particle, alike: all.len(), what: format!("whose {} is no number", list.join(" and ")) })
}

/// The particle of which the square of the velocity is no number any more.
fn fastest(moment: &Moment) -> Option<Place> {
    let speed = |i: usize| moment.vector(Field::Velocity, i).iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let particle = (0..moment.count()).max_by(|&a, &b| speed(a).total_cmp(&speed(b)))?;
    Some(Place { particle, alike: 1, what: format!("which is the fastest, at {:.2e}", speed(particle)) })
}

/// The particle with the smallest volume.
fn inverted(moment: &Moment) -> Option<Place> {
    let volume = |i: usize| 1.0 + moment.volumetric_strain(i);
    let all: Vec<usize> = (0..moment.count()).filter(|&i| volume(i) <= 0.0).collect();
    let particle = all.iter().copied().min_by(|&a, &b| volume(a).total_cmp(&volume(b)))?;
    Some(Place { particle, alike: all.len(), what: format!("whose volume is {:.2e} of the unstressed one", volume(particle)) })
}

/// The particle with the most neighbours.
fn crowded(moment: &Moment) -> Option<Place> {
    let neighbours = |i: usize| moment.scalar(Field::NeighborCount, i);
    let particle = (0..moment.count()).max_by(|&a, &b| neighbours(a).total_cmp(&neighbours(b)))?;
    Some(Place { particle, alike: 1, what: format!("which has the most neighbours, {}", neighbours(particle)) })
}

/// The particle on which the force is the most out of balance.
fn pulled(moment: &Moment) -> Option<Place> {
    let force = |i: usize| balance::unbalanced(moment, i).length();
    let particle = (0..moment.count()).max_by(|&a, &b| force(a).total_cmp(&force(b)))?;
    Some(Place { particle, alike: 1, what: format!("on which the force out of balance is the largest, {:.2e}", force(particle)) })
}

/// What may help, beside what the fault's own sentence says.
pub fn remedy(scene: &Scene, fault: Fault, clock: &Clock<f64>) -> Option<String> {
    let time = &scene.file.time;
    let shorter = match (&scene.file.quasi_static, time.step) {
        (Some(typed), _) => format!("try quasi_static.load_steps = {} in place of {}", 2 * typed.load_steps, typed.load_steps),
        (None, Some(step)) => format!("try time.step = {:.2e} in place of {step:.2e}", 0.5 * step),
        (None, None) => {
            format!("the last step was {:.2e}: try time.cfl = {} in place of {}", clock.step, 0.5 * time.cfl, time.cfl)
        }
    };
    match fault {
        Fault::NotFinite | Fault::Inverted => Some(format!(
            "{shorter}; if that does not help, less load or speed, or a finer spacing where it is the most deformed"
        )),
        Fault::NoEquilibrium => Some(format!("{shorter}, or a larger quasi_static.most_steps")),
        Fault::ListFull => None,
    }
}
