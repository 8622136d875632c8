//! The path of a point, for comparison with one of a reference.

use super::table::Table;
use super::{ObservableKind, Value};
use crate::scene::file::Observe;

pub const TRACE: ObservableKind = ObservableKind {
    word: "trace",
    about: "series `of` and `over` as the two coordinates of a point: compared with three columns of a reference, by distance",
    needs: &["of", "over"],
    fields: &[],
    value: Value::Trace,
};

/// Times and points, within the observable's window.
pub fn trace(table: &Table, typed: &Observe) -> Result<Vec<(f64, Vec<f64>)>, String> {
    let column = |name: &Option<String>| table.window(name.as_deref().unwrap_or_default(), typed);
    let (first, second) = (column(&typed.of)?, column(&typed.over)?);
    Ok(first.iter().zip(&second).map(|(a, b)| (a.0, vec![a.1, b.1])).collect())
}
