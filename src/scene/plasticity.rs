//! Refuses what a scene with a body that yields cannot have.

use super::SceneBody;
use super::file::File;
use super::refuse::Refuse;
use crate::material::Law;
use crate::method::Formulation;

pub(super) fn check(file: &File, bodies: &[SceneBody], refuse: &Refuse) -> Result<(), String> {
    let Some(strength) = bodies.iter().filter_map(|body| body.material.strength).find(|law| law.yields()) else {
        return Ok(());
    };
    refuse.unless(file.formulation.kind != Formulation::CorrectedKernel, &["formulation", "kind"], || {
        format!("the law `{}` needs formulation.kind `eulerian` or `total_lagrangian`", strength.word())
    })?;
    let heats = bodies.iter().any(|body| body.material.heat == Some(Law::Adiabatic));
    refuse.unless(file.quasi_static.is_none() || !heats, &["quasi_static"], || {
        "the heat `adiabatic` follows plastic work step by step in time, and a quasi_static scene has no time".into()
    })?;
    let adds_up = file.formulation.dissipated_energy;
    refuse.unless(file.quasi_static.is_none() || !adds_up, &["formulation", "dissipated_energy"], || {
        "dissipated_energy adds up plastic work step by step in time, and a quasi_static scene has no time".into()
    })
}
