//! A field along an axis through the particles of a selection, taken at the end of a run.

use super::momentum::component;
use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;

pub const PROFILE: ObservableKind = ObservableKind {
    word: "profile",
    about: "field of every selected particle against its starting position along `axis`, at the end; with `over`, divided by that series' last value",
    needs: &["field", "axis"],
    fields: &[Field::Displacement],
    value: Value::Profile,
};

/// Rows of starting position and value, in order of position.
pub fn profile(moment: &Moment, observer: &Observer) -> Vec<(f64, f64)> {
    let values = moment.path(observer.typed.field.as_deref().unwrap_or_default(), &observer.particles);
    let place = |i: usize| component(moment.scene.particles[i].position, observer);
    let mut rows: Vec<(f64, f64)> = observer.particles.iter().map(|&i| place(i)).zip(values).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows
}
