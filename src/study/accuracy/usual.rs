//! The matrix of a scene that brings none: resolution, integrator and time step with each other, on which error and cost
//! hang most, and beside the scene's own choice each other choice of kernel, formulation and stabilisation, one at a time.

use super::axis::{Axis, Value};
use super::matrix::Group;
use crate::material::Law;
use crate::method::{Formulation, Gradient};
use crate::scene::Scene;
use crate::scene::file::BodyTable;
use crate::smoothing::Smoothing;
use glam::DVec3;

/// Particles up to which half the spacing is tried too.
const FEW: usize = 10_000;

/// Groups that mean something for the scene.
pub fn groups(scene: &Scene) -> Vec<Group> {
    let (file, typed) = (&scene.file, &scene.file.formulation);
    let gradient = typed.gradient();
    let mut groups = vec![resolution(scene)];
    let kernels = Smoothing::ALL.iter().filter(|kernel| **kernel != typed.smoothing).map(|kernel| kernel.word().to_string());
    groups.push(vec![axis("formulation.smoothing", kernels.map(|word| Value::parse(&word)).collect())]);
    groups.push(vec![others("formulation.smoothing_length", &[1.2, 1.3, 1.5, 1.8], Some(typed.smoothing_length))]);
    match typed.kind {
        Formulation::TotalLagrangian => {
            groups.push(vec![others(
                "formulation.hourglass",
                &[0.1, 0.2, 0.5],
                Some(file.formulation.hourglass(file.body.iter().any(|body| file.yields(body)))),
            )]);
            groups.push(words("formulation.gradient", &[if gradient == Gradient::Quadratic { "adjoint" } else { "quadratic" }]));
        }
        Formulation::Eulerian => {
            let alpha = typed.viscosity.as_ref().map(|viscosity| viscosity.alpha);
            groups.push(vec![others("formulation.viscosity.alpha", &[0.1, 1.0], alpha)]);
            groups.push(vec![others("formulation.xsph", &[0.1, 0.5], typed.xsph)]);
            groups.push(words("formulation.gradient", &[if gradient == Gradient::Adjoint { "plain" } else { "adjoint" }]));
        }
        Formulation::CorrectedKernel => groups.push(words("formulation.configuration", &["current", "reference"])),
    }
    groups.push(vec![axis("formulation.kind", vec![other_formulation(scene)])]);
    groups
}

fn axis(path: &str, values: Vec<Value>) -> Axis {
    Axis { path: path.into(), values, place: "the usual matrix".into() }
}

fn words(path: &str, values: &[&str]) -> Group {
    vec![axis(path, values.iter().map(|text| Value::parse(text)).collect())]
}

/// Numbers but the scene's own.
fn others(path: &str, values: &[f64], own: Option<f64>) -> Axis {
    let values = values.iter().filter(|value| Some(**value) != own);
    axis(path, values.map(|value| Value::parse(&format!("{value:?}"))).collect())
}

fn resolution(scene: &Scene) -> Group {
    let number = |value: f64| Value::parse(&format!("{value:?}"));
    let (spacing, time) = (scene.file.spacing, &scene.file.time);
    let mut group = Vec::new();
    if halves(scene) {
        group.push(axis("spacing", vec![number(spacing), number(spacing / 2.0)]));
    }
    // In equilibrium there is no motion to integrate.
    if scene.file.quasi_static.is_none() {
        group.extend(words("time.integrator", &["leapfrog", "pefrl", "ssp_rk3", "rk4"]));
    }
    // A fixed step leaves the Courant number without effect.
    if time.step.is_none() {
        group.push(axis("time.cfl", vec![number(time.cfl), number(time.cfl / 2.0)]));
    }
    group
}

/// Half the spacing is the same scene, finer, only where no lattice is anchored but at the origin (mostly half a spacing off a
/// face) and no body has a spacing of its own.
fn halves(scene: &Scene) -> bool {
    let finer = scene.particles.len() << scene.dimension();
    let anchored = |body: &BodyTable| body.anchor.as_ref().is_some_and(|anchor| anchor.vector() != DVec3::ZERO);
    finer <= FEW && scene.file.body.iter().all(|body| !anchored(body) && body.spacing.is_none())
}

/// The Total Lagrangian of an Eulerian scene, with what it needs and without what it lacks, and the other way round.
fn other_formulation(scene: &Scene) -> Value {
    let typed = &scene.file.formulation;
    let (kind, from, to) = match typed.kind {
        Formulation::Eulerian => ("total_lagrangian", Law::Elastic, "st_venant_kirchhoff"),
        Formulation::TotalLagrangian | Formulation::CorrectedKernel => ("eulerian", Law::NeoHookean, "elastic"),
    };
    let given = [
        ("viscosity", typed.viscosity.is_some()),
        ("xsph", typed.xsph.is_some()),
        ("velocity_filter", typed.velocity_filter.is_some()),
        ("artificial_stress", typed.artificial_stress.is_some()),
        ("gradient", typed.gradient.is_some()),
        ("hourglass", typed.hourglass.is_some()),
        ("bond_table", typed.bond_table.is_some()),
        ("correction", typed.correction.is_some()),
        ("configuration", typed.configuration.is_some()),
        ("deformation", typed.deformation.is_some()),
        ("velocity_gradient", typed.velocity_gradient.is_some()),
    ];
    let removed = given.iter().filter(|(_, given)| *given).map(|(key, _)| format!("formulation.{key}=none"));
    let elastic = |law: Law| law == from || (kind == "eulerian" && law == Law::StVenantKirchhoff);
    let laws = scene.file.material.iter().filter(|(_, material)| material.named().is_some_and(elastic));
    let laws = laws.map(|(name, _)| format!("material.{name}.law={to}"));
    // Without them the Eulerian form breaks in tension.
    let calmed: &[&str] = match kind {
        "eulerian" => &["formulation.viscosity={ alpha = 1.0 }", "formulation.xsph=0.5"],
        _ => &["formulation.smoothing_length=1.3"],
    };
    let also = removed.chain(laws).chain(calmed.iter().map(|text| (*text).to_string())).collect();
    Value::parse(kind).and(also)
}
