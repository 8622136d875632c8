//! Numbers of a run and their errors.

use super::distance::distance;
use crate::observable::{KINDS, Value};
use crate::output::csv::shortest;
use crate::run::Finished;
use crate::scene::Scene;
use crate::scene::file::{Expect, Scale, Statistic};
use std::path::Path;

/// What a run gave beside what was expected.
pub struct Compared {
    /// The observable, or the distance from a reference in the unit of the tolerance.
    pub number: f64,
    /// The observable less the truth, or the distance, in the observable's own unit; none without a truth.
    pub error: Option<f64>,
    /// What the error is a fraction of, in its own unit, and in words.
    pub scale: f64,
    pub of: String,
    /// Unit of the tolerance on `error`: the scale of a relative expectation, else 1.
    pub unit: f64,
    /// Unit of the tolerance on `number`, where the expectation names what is seen.
    pub unit_of_seen: f64,
}

pub fn compare(scene: &Scene, finished: &Finished, folder: &Path, name: &str, expect: &Expect) -> Result<Compared, String> {
    if let Some(reference) = &expect.reference {
        let found = distance(scene, finished, &folder.join(reference), name, expect)?;
        let unit = if expect.relative { found.scale } else { 1.0 };
        let (number, error) = (found.gap / unit, Some(found.gap));
        return Ok(Compared { number, error, scale: found.scale, of: found.of, unit, unit_of_seen: 1.0 });
    }
    let number = number(scene, finished, name, expect)?;
    let (scale, of) = match (expect.scale, expect.value, expect.seen) {
        (Some(Scale::Number(scale)), _, _) => (scale, shortest(scale)),
        (_, Some(value), _) if value != 0.0 => (value.abs(), "value".into()),
        (_, None, Some(seen)) => (seen.abs(), "seen".into()),
        _ => largest(scene, finished, name),
    };
    let unit = if expect.relative { scale } else { 1.0 };
    Ok(Compared { number, error: expect.value.map(|value| number - value), scale, of, unit, unit_of_seen: unit })
}

/// Of a number of its own nothing is larger: it is its own unit.
fn largest(scene: &Scene, finished: &Finished, name: &str) -> (f64, String) {
    let of = |values: Vec<f64>| values.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
    match values(scene, finished, name).map(of) {
        Ok(largest) if largest > 0.0 => (largest, "largest".into()),
        _ => (1.0, "1".into()),
    }
}

/// How far a run ended from an expectation's value or reference, in the unit of the tolerance: a fraction where the
/// expectation is `relative`.
///
/// # Errors
/// One sentence where the run gave no number to compare, or the expectation has neither value nor reference.
pub fn error(scene: &Scene, finished: &Finished, folder: &Path, name: &str, expect: &Expect) -> Result<f64, String> {
    let found = compare(scene, finished, folder, name, expect)?;
    let error = found.error.ok_or_else(|| format!("{name}: has neither value nor reference, so that there is no error"))?;
    Ok(if error == 0.0 { 0.0 } else { error.abs() / found.unit })
}

/// How far a run ended from an expectation's value as a fraction of it, or where it is 0 of the largest number of the
/// run's own series.
///
/// # Errors
/// One sentence where the run gave no number to compare, or there is nothing to be a fraction of.
pub fn fraction(scene: &Scene, finished: &Finished, name: &str, expect: &Expect) -> Result<f64, String> {
    let value = expect.value.ok_or_else(|| format!("{name}: has no value"))?;
    let gap = (number(scene, finished, name, expect)? - value).abs();
    let largest = |values: Vec<f64>| values.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
    let scale = if value == 0.0 { largest(values(scene, finished, name)?) } else { value.abs() };
    if gap == 0.0 { Ok(0.0) } else { Ok(gap / scale) }
}

/// One number of an observable: a result, or a statistic of its series.
///
/// # Errors
/// One sentence where the run gave none.
pub fn number(scene: &Scene, finished: &Finished, name: &str, expect: &Expect) -> Result<f64, String> {
    let typed = &scene.file.observe[name];
    let kind = KINDS.iter().find(|k| k.word == typed.kind).ok_or("unknown kind")?;
    if let Value::Result(of) = kind.value {
        return of(&finished.table, typed).map_err(|e| format!("{name}: {e}"));
    }
    Ok(statistic(&values(scene, finished, name)?, expect.statistic.unwrap_or(Statistic::Final)))
}

/// A profile, or a series within its window.
fn values(scene: &Scene, finished: &Finished, name: &str) -> Result<Vec<f64>, String> {
    Ok(match finished.profiles.get(name) {
        Some(rows) => rows.iter().map(|r| r.1).collect(),
        None => finished.table.window(name, &scene.file.observe[name])?.into_iter().map(|r| r.1).collect(),
    })
}

fn statistic(values: &[f64], statistic: Statistic) -> f64 {
    let (first, last) = (values[0], values[values.len() - 1]);
    // A NaN makes the extreme NaN, which no tolerance admits; `max` and `min` alone would skip it.
    if values.iter().any(|v| v.is_nan()) {
        return f64::NAN;
    }
    match statistic {
        Statistic::First => first,
        Statistic::Final => last,
        Statistic::Min => values.iter().copied().fold(f64::INFINITY, f64::min),
        Statistic::Max => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        Statistic::Mean => values.iter().sum::<f64>() / values.len() as f64,
        Statistic::Drift => values.iter().map(|v| (v - first).abs()).fold(0.0, f64::max),
    }
}
