//! Refuses what a scene that seeks equilibrium cannot have.

use super::SceneBody;
use super::file::{File, QuasiStatic};
use super::refuse::{MOST_OUTPUTS, Refuse};
use crate::method::{Formulation, Integrator};

pub(super) fn check(file: &File, bodies: &[SceneBody], refuse: &Refuse) -> Result<(), String> {
    let Some(typed) = &file.quasi_static else { return Ok(()) };
    numbers(typed, refuse)?;
    outputs(file, typed, refuse)?;
    let lagrangian = file.formulation.kind == Formulation::TotalLagrangian;
    refuse.unless(lagrangian, &["quasi_static"], || {
        "equilibrium is sought in the Total Lagrangian formulation alone: formulation.kind must be `total_lagrangian`".into()
    })?;
    refuse.unless(file.formulation.viscosity.is_none(), &["formulation", "viscosity"], || {
        "viscosity does nothing in equilibrium, and this scene is quasi_static".into()
    })?;
    for (k, body) in bodies.iter().enumerate() {
        let path = ["body", &k.to_string(), "material"];
        refuse.unless(!body.material.creeps(), &path, || {
            format!("body `{}` creeps for ever by its law: a quasi_static scene has no time for it", body.name)
        })?;
    }
    refuse.unless(file.time.integrator == Integrator::Leapfrog, &["time", "integrator"], || {
        "a quasi_static scene integrates nothing in time: it takes no time.integrator, but quasi_static.method".into()
    })?;
    refuse.unless(file.time.step.is_none(), &["time", "step"], || {
        "a quasi_static scene takes no time.step: time.cfl bounds the steps of the descent".into()
    })?;
    let moving = file.body.iter().any(|b| b.velocity.is_some() || b.spin != 0.0 || b.motion.is_some());
    refuse.unless(!moving && file.kick.is_empty(), &["quasi_static"], || {
        "a quasi_static scene starts at rest: bodies take no velocity, spin, motion or kick".into()
    })
}

fn numbers(typed: &QuasiStatic, refuse: &Refuse) -> Result<(), String> {
    let few = (1..=MOST_OUTPUTS as u32).contains(&typed.load_steps);
    refuse.unless(few, &["quasi_static", "load_steps"], || {
        format!("load_steps must be 1 to {MOST_OUTPUTS:e}, found {}", typed.load_steps)
    })?;
    // Below this residual, forces cannot be told from rounding errors even in f64.
    refuse.unless((1e-12..1.0).contains(&typed.residual), &["quasi_static", "residual"], || {
        format!("residual must lie between 1e-12 and 1, found {:e}", typed.residual)
    })?;
    refuse.unless(typed.most_steps > 0, &["quasi_static", "most_steps"], || "most_steps must not be 0".into())
}

fn outputs(file: &File, typed: &QuasiStatic, refuse: &Refuse) -> Result<(), String> {
    refuse.unless(file.output.series.is_none(), &["output", "series"], || {
        "each load step of a quasi_static scene is a row: output.series does not go with it".into()
    })?;
    let step = file.duration / f64::from(typed.load_steps);
    let frames = file.frames();
    refuse.unless(frames == 0.0 || frames >= step * (1.0 - 1e-9), &["output", "frames"], || {
        format!("frames must not be shorter than a load step, which is {step:e}")
    })
}
