//! Displacement of a material point that need not be a particle: an edge, a tip.

use super::momentum::component;
use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;
use glam::DVec3;

/// Displacement of the nearest particle, plus its displacement gradient times the separation from the particle to the point.
fn displacement(moment: &Moment, observer: &Observer) -> f64 {
    let i = observer.particles[0];
    let start = moment.scene.particles[i].position;
    let way = observer.typed.at.as_ref().map_or(DVec3::ZERO, |at| at.vector() - start);
    let carried = moment.matrix(Field::DisplacementGradient, i) * way;
    component(DVec3::from_array(moment.vector(Field::Displacement, i)) + carried, observer)
}

pub const POINT: ObservableKind = ObservableKind {
    word: "point_displacement",
    about: "displacement of the material point that starts at `at`, from the nearest particle and its displacement gradient",
    needs: &["at", "axis"],
    fields: &[Field::Displacement, Field::DisplacementGradient],
    value: Value::Series(displacement),
};
