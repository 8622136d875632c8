//! How far a body has turned about z.

use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;
use glam::DVec3;

fn angle(moment: &Moment, observer: &Observer) -> f64 {
    let (mut now, mut start, mut mass) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for &i in &observer.particles {
        let m = moment.scene.mass(i);
        now += DVec3::from_array(moment.position(i)) * m;
        start += moment.scene.particles[i].position * m;
        mass += m;
    }
    let (now, start) = (now / mass, start / mass);
    let (mut sine, mut cosine) = (0.0, 0.0);
    for &i in &observer.particles {
        let m = moment.scene.mass(i);
        let (x, reference) = (DVec3::from_array(moment.position(i)) - now, moment.scene.particles[i].position - start);
        sine += m * (reference.x * x.y - reference.y * x.x);
        cosine += m * (reference.x * x.x + reference.y * x.y);
    }
    sine.atan2(cosine).to_degrees()
}

pub const ANGLE: ObservableKind = ObservableKind {
    word: "rotation_angle",
    about: "best-fitting rotation about z since the start, in degrees; the series is unwrapped over full turns",
    needs: &[],
    fields: &[Field::Displacement],
    value: Value::Series(angle),
};
