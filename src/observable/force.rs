//! Force on a body or on the particles of a boundary condition.

use super::momentum::component;
use super::{ObservableKind, Value};
use crate::fields::Field;
use glam::DVec3;

pub const FORCE: ObservableKind = ObservableKind {
    word: "force",
    about: "sum of m a over the selection, before constraints: what the rest of the scene does to it; inner forces cancel",
    needs: &[],
    fields: &[Field::Acceleration],
    value: Value::Series(|moment, observer| {
        let force = |&i: &usize| DVec3::from_array(moment.vector(Field::Acceleration, i)) * moment.scene.mass(i);
        component(observer.particles.iter().map(force).sum(), observer)
    }),
};
