//! Momenta and means weighted by mass.

use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;
use glam::DVec3;

/// Component of a vector along the observer's axis, or its length where the observer has none.
pub fn component(vector: DVec3, observer: &Observer) -> f64 {
    observer.axis.map_or_else(|| vector.length(), |k| vector.to_array()[k])
}

fn sum(moment: &Moment, observer: &Observer, of: impl Fn(usize) -> DVec3) -> DVec3 {
    observer.particles.iter().map(|&i| of(i) * moment.scene.mass(i)).sum()
}

fn velocity(moment: &Moment, i: usize) -> DVec3 {
    DVec3::from_array(moment.vector(Field::Velocity, i))
}

fn position(moment: &Moment, i: usize) -> DVec3 {
    DVec3::from_array(moment.position(i))
}

fn mass(moment: &Moment, observer: &Observer) -> f64 {
    observer.particles.iter().map(|&i| moment.scene.mass(i)).sum()
}

pub const LINEAR: ObservableKind = ObservableKind {
    word: "momentum",
    about: "sum of m v, along axis or its length",
    needs: &[],
    fields: &[Field::Velocity],
    value: Value::Series(|moment, observer| component(sum(moment, observer, |i| velocity(moment, i)), observer)),
};

pub const ANGULAR: ObservableKind = ObservableKind {
    word: "angular_momentum",
    about: "sum of m x cross v about the origin, along axis (z unless given)",
    needs: &[],
    fields: &[Field::Displacement, Field::Velocity],
    value: Value::Series(|moment, observer| {
        let total = sum(moment, observer, |i| position(moment, i).cross(velocity(moment, i)));
        total.to_array()[observer.axis.unwrap_or(2)]
    }),
};

pub const VELOCITY: ObservableKind = ObservableKind {
    word: "mean_velocity",
    about: "momentum over mass",
    needs: &[],
    fields: &[Field::Velocity],
    value: Value::Series(|moment, observer| {
        component(sum(moment, observer, |i| velocity(moment, i)) / mass(moment, observer), observer)
    }),
};

pub const POSITION: ObservableKind = ObservableKind {
    word: "mean_position",
    about: "centre of mass",
    needs: &[],
    fields: &[Field::Displacement],
    value: Value::Series(|moment, observer| {
        component(sum(moment, observer, |i| position(moment, i)) / mass(moment, observer), observer)
    }),
};
