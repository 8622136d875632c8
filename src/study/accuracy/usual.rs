//! The matrix of a scene that brings none: the numbers that each scene has, and on which error and cost hang most.

use super::matrix::{Axis, Value};
use crate::scene::Scene;

/// Particles up to which half the spacing is tried too.
const FEW: usize = 10_000;

/// Axes that mean something for the scene.
pub fn axes(scene: &Scene) -> Vec<Axis> {
    let axis = |path: &str, values: &[&str]| {
        let values = values.iter().map(|text| Value::parse(text)).collect();
        Axis { path: path.into(), values, place: "the usual matrix".into() }
    };
    let mut axes = Vec::new();
    if halves(scene) {
        let spacing = scene.file.spacing;
        axes.push(axis("spacing", &[&format!("{spacing:?}"), &format!("{:?}", spacing / 2.0)]));
    }
    axes.push(axis("formulation.smoothing_length", &["1.2", "1.3", "1.5"]));
    axes.push(axis("time.integrator", &["leapfrog", "ssp_rk3"]));
    // A fixed step leaves the Courant number without effect.
    if scene.file.time.step.is_none() {
        axes.push(axis("time.cfl", &["0.2", "0.4"]));
    }
    axes
}

/// Half the spacing is the same scene, finer, only where no lattice is anchored (mostly half a spacing off a face) and
/// no body has a spacing of its own.
fn halves(scene: &Scene) -> bool {
    let finer = scene.particles.len() << scene.dimension();
    finer <= FEW && scene.file.body.iter().all(|body| body.anchor.is_none() && body.spacing.is_none())
}
