//! What can be said of the energy of a scene: whether it is a constant, can only fall, or is not known.

use crate::method::{Formulation, GapForm, Integrator, Method};
use crate::scene::Scene;

/// How the sum of the energies is judged.
#[derive(Debug, Clone, PartialEq)]
pub enum Judged {
    /// The sum is a constant: nothing is lost, or all losses are added up.
    Kept,
    /// Losses are not added up: the sum never grows. Names them.
    Falling(String),
    /// Something stores energy that is not counted and gives it back: the sum never grows beyond that of the start. Names it.
    Bounded(String),
    /// Nothing can be said, for this reason.
    Not(String),
}

impl Judged {
    pub fn reason_against(&self) -> Option<&str> {
        if let Self::Not(reason) = self { Some(reason) } else { None }
    }

    pub fn losses(&self) -> Option<&str> {
        match self {
            Self::Falling(losses) | Self::Bounded(losses) => Some(losses),
            Self::Kept | Self::Not(_) => None,
        }
    }
}

pub(super) fn judged(scene: &Scene) -> Judged {
    if let Some(reason) = driven(scene) {
        return Judged::Not(reason);
    }
    let mut losses: Vec<&str> = scene.members().flat_map(|member| losses(&member.method)).collect();
    let hidden: Vec<&str> = scene.members().flat_map(|member| hidden(&member.method)).collect();
    if hidden.is_empty() && losses.is_empty() {
        return Judged::Kept;
    }
    let bounded = !hidden.is_empty();
    losses.extend(hidden);
    losses.sort_unstable();
    losses.dedup();
    if bounded { Judged::Bounded(losses.join(", ")) } else { Judged::Falling(losses.join(", ")) }
}

/// What works on the bodies without its work being known.
fn driven(scene: &Scene) -> Option<String> {
    if scene.file.quasi_static.is_some() {
        return Some("equilibrium is sought at each load step, and the descent to it loses energy".into());
    }
    // Each obstacle that is not free has a condition of its own.
    let of_obstacle = |k: usize| scene.obstacles.iter().find(|obstacle| obstacle.condition == Some(k));
    scene.constraints.iter().enumerate().find_map(|(k, condition)| match of_obstacle(k) {
        Some(obstacle) => condition.drives().then(|| format!("obstacle `{}` is driven by a velocity", obstacle.name)),
        None if condition.drives() => Some(format!("`{}` is driven by a velocity", condition.name)),
        None if condition.pushes_unsteadily() => {
            Some(format!("`{}` is pushed by a force that changes with time", condition.name))
        }
        None => None,
    })
}

/// What turns energy into heat that the run does not add up.
fn losses(method: &Method) -> Vec<&'static str> {
    let mut list = Vec::new();
    if !method.dissipated_energy {
        let viscous = method.laws.iter().any(|law| law.has_memory() && !law.yields());
        let counted = [
            (method.viscosity, "viscosity"),
            (method.plastic(), "plastic work"),
            (method.finite_strain() && viscous, "creep"),
            (method.friction, "friction"),
        ];
        list.extend(counted.into_iter().filter(|(present, _)| *present).map(|(_, word)| word));
    }
    let uncounted = [(method.zones_friction(), "friction in zones"), (method.velocity_filter, "the velocity filter")];
    list.extend(uncounted.into_iter().filter(|(present, _)| *present).map(|(_, word)| word));
    list
}

/// What stores energy, or takes and gives it, without having one that is counted.
fn hidden(method: &Method) -> Vec<&'static str> {
    let present = [
        (!method.between && method.formulation == Formulation::Eulerian, "stress by rates"),
        (method.formulation == Formulation::CorrectedKernel, "corrected kernels"),
        (method.contact.zones.is_some(), "contact by zones"),
        (method.along_normals(), "contact along normals"),
    ];
    present.into_iter().filter(|(present, _)| *present).map(|(_, word)| word).collect()
}

/// What to try when the energy drifts: first what is known to make energy, then the step.
pub(super) fn remedy(scene: &Scene) -> String {
    let any = |has: fn(&Method) -> bool| scene.members().any(|member| has(&member.method));
    let mut list = Vec::new();
    if any(|m| m.contact.zones.is_some()) {
        list.push("contact by `zones` has no energy to keep: a `potential` or a `gap` has".to_string());
    }
    if any(|m| m.gap == Some(GapForm::AlongNormals)) {
        list.push("a gap of the form `along_normals` has no energy to keep: the form `potential` has".into());
    }
    if any(|m| m.integrator == Integrator::Rk2) {
        list.push("rk2 makes energy at any step: `leapfrog` keeps it".into());
    }
    if any(|m| !m.between && m.formulation == Formulation::Eulerian) {
        list.push("the Eulerian formulation keeps it only roughly: `total_lagrangian` keeps it".into());
    }
    let time = &scene.file.time;
    list.push(match time.step {
        Some(step) => format!("try time.step = {:.2e} in place of {step:.2e}", 0.5 * step),
        None => format!("try time.cfl = {} in place of {}", 0.5 * time.cfl, time.cfl),
    });
    list.push("`[watch] energy = \"warn\"`, or --energy warn, goes on".into());
    list.join("; ")
}
