//! A field at a place, or its mean or extreme over a selection.

use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;
use glam::DVec3;

fn path(observer: &Observer) -> &str {
    observer.typed.field.as_deref().unwrap_or("velocity.x")
}

fn probe(moment: &Moment, observer: &Observer) -> f64 {
    match (&observer.typed.at, observer.typed.interpolate) {
        (Some(at), true) => interpolate(moment, at.vector(), path(observer)),
        _ => moment.path(path(observer), &observer.particles[..1])[0],
    }
}

/// Sum of V f W over sum of V W: exact for a constant, whatever part of the kernel lies outside the body.
fn interpolate(moment: &Moment, at: DVec3, path: &str) -> f64 {
    let scene = moment.scene;
    let (mut particles, mut weights) = (Vec::new(), Vec::new());
    for i in 0..moment.count() {
        let smoothing = scene.group_of(i).method.smoothing;
        let h = scene.bodies[scene.particles[i].body as usize].smoothing_length;
        let distance = DVec3::from_array(moment.position(i)).distance(at);
        let weight = scene.particles[i].volume * smoothing.value(distance, h, scene.dimension());
        if weight > 0.0 {
            particles.push(i);
            weights.push(weight);
        }
    }
    let values = moment.path(path, &particles);
    values.iter().zip(&weights).map(|(v, w)| v * w).sum::<f64>() / weights.iter().sum::<f64>()
}

pub const PROBE: ObservableKind = ObservableKind {
    word: "probe",
    about: "field of the particle that starts nearest to `at`, or with `interpolate` the kernel's mean at that fixed point",
    needs: &["field", "at"],
    fields: &[Field::Displacement],
    value: Value::Series(probe),
};

pub const MEAN: ObservableKind = ObservableKind {
    word: "mean",
    about: "mean of a field over the selection, weighted by mass",
    needs: &["field"],
    fields: &[],
    value: Value::Series(|moment, observer| {
        let mass = |i: usize| moment.scene.mass(i);
        let values = moment.path(path(observer), &observer.particles);
        let sum: f64 = values.iter().zip(&observer.particles).map(|(v, &i)| v * mass(i)).sum();
        sum / observer.particles.iter().map(|&i| mass(i)).sum::<f64>()
    }),
};

pub const LARGEST: ObservableKind = ObservableKind {
    word: "largest",
    about: "largest value of a field over the selection",
    needs: &["field"],
    fields: &[],
    value: Value::Series(|moment, observer| {
        moment.path(path(observer), &observer.particles).into_iter().fold(f64::NEG_INFINITY, f64::max)
    }),
};

pub const SMALLEST: ObservableKind = ObservableKind {
    word: "smallest",
    about: "smallest value of a field over the selection",
    needs: &["field"],
    fields: &[],
    value: Value::Series(|moment, observer| {
        moment.path(path(observer), &observer.particles).into_iter().fold(f64::INFINITY, f64::min)
    }),
};
