//! Compares a finished run with what its scene expects.

mod distance;

use crate::observable::{KINDS, Value};
use crate::run::Finished;
use crate::scene::Scene;
use crate::scene::file::{Expect, Statistic};
use distance::{distance, reference};
use std::path::Path;

/// How a comparison came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Pass,
    Miss,
    /// Inside the range that a method is known to give where it is wrong.
    KnownMiss,
}

/// One line of the table.
#[derive(Debug, Clone)]
pub struct Row {
    pub scene: String,
    pub name: String,
    pub seen: f64,
    pub expected: String,
    pub tolerance: String,
    pub source: String,
    pub verdict: Verdict,
}

/// All expectations that hold for the scene's variant.
pub fn rows(scene: &Scene, finished: &Finished, folder: &Path) -> Result<Vec<Row>, String> {
    let wanted = scene.file.expect.iter().filter(|(_, e)| applies(scene, e));
    wanted.map(|(name, expect)| row(scene, finished, folder, name, expect)).collect()
}

/// Whether an expectation holds for the scene's variant.
pub fn applies(scene: &Scene, expect: &Expect) -> bool {
    match expect.variant.as_deref() {
        None => true,
        Some("none") => scene.variant.is_none(),
        Some(variant) => scene.variant.as_deref() == Some(variant),
    }
}

/// How far a run ended from an expectation's value or reference, in the unit of the tolerance: a fraction where the
/// expectation is `relative`.
///
/// # Errors
/// One sentence where the run gave no number to compare, or the expectation has neither value nor reference.
pub fn error(scene: &Scene, finished: &Finished, folder: &Path, name: &str, expect: &Expect) -> Result<f64, String> {
    match (&expect.reference, expect.value) {
        (Some(reference), _) => distance(scene, finished, &folder.join(reference), name, expect),
        (None, Some(value)) => Ok(gap(number(scene, finished, name, expect)?, value, expect)),
        (None, None) => Err(format!("{name}: has neither value nor reference, so that there is no error")),
    }
}

fn gap(seen: f64, value: f64, expect: &Expect) -> f64 {
    let gap = (seen - value).abs();
    if gap > 0.0 && expect.relative { gap / value.abs() } else { gap }
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

/// Reads every reference that a scene names, so that a missing one shows before the run.
pub fn references(scene: &Scene, folder: &Path) -> Result<(), String> {
    let named = scene.file.expect.values().filter_map(|expect| Some((expect.reference.as_ref()?, expect)));
    named.into_iter().try_for_each(|(name, expect)| reference(&folder.join(name), expect).map(|_| ()))
}

/// The line of a run that did not come to its end.
pub fn failed(scene: &Scene, reason: String) -> Row {
    let (name, expected, tolerance) = ("run".into(), "an end".into(), String::new());
    Row { scene: scene.label(), name, seen: f64::NAN, expected, tolerance, source: reason, verdict: Verdict::Miss }
}

fn row(scene: &Scene, finished: &Finished, folder: &Path, name: &str, expect: &Expect) -> Result<Row, String> {
    let row = |seen: f64, expected: String, tolerance: String, verdict| Row {
        scene: scene.label(),
        name: name.into(),
        seen,
        expected,
        tolerance,
        source: expect.source.clone(),
        verdict,
    };
    let judge = |holds| if holds { Verdict::Pass } else { Verdict::Miss };
    let bound = expect.tolerance.unwrap_or(0.0);
    let seen = match &expect.reference {
        Some(reference) => distance(scene, finished, &folder.join(reference), name, expect)?,
        None => number(scene, finished, name, expect)?,
    };
    if let Some([low, high]) = expect.between {
        let verdict = if (low..=high).contains(&seen) { Verdict::KnownMiss } else { Verdict::Miss };
        let because = expect.because.clone().unwrap_or_default();
        return Ok(row(seen, format!("{low} .. {high}"), because, verdict));
    }
    if let Some(reference) = &expect.reference {
        return Ok(row(seen, reference.clone(), format!("{bound}"), judge(seen <= bound)));
    }
    let value = expect.value.unwrap_or(0.0);
    let shown = if expect.relative { format!("{} %", 100.0 * bound) } else { format!("{bound:e}") };
    Ok(row(seen, format!("{value}"), shown, judge(gap(seen, value, expect) <= bound)))
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

/// The table as text.
pub fn text(rows: &[Row]) -> String {
    let longest = |of: fn(&Row) -> &str| rows.iter().map(|row| of(row).len()).max().unwrap_or(0).max(10);
    let (scene, name, expected) = (longest(|r| &r.scene), longest(|r| &r.name), longest(|r| &r.expected));
    let mut out = format!(
        "{:<scene$} {:<name$} {:>13} {:>expected$} {:<14} {:<10} source\n",
        "scene", "observable", "seen", "expected", "tolerance", ""
    );
    for row in rows {
        let verdict = match row.verdict {
            Verdict::Pass => "pass",
            Verdict::Miss => "MISS",
            Verdict::KnownMiss => "known miss",
        };
        let (tolerance, because) = if row.verdict == Verdict::KnownMiss || row.expected.contains("..") {
            ("range", format!("; {}", row.tolerance))
        } else {
            (row.tolerance.as_str(), String::new())
        };
        out += &format!(
            "{:<scene$} {:<name$} {:>13.6e} {:>expected$} {:<14} {:<10} {}{because}\n",
            row.scene, row.name, row.seen, row.expected, tolerance, verdict, row.source
        );
    }
    out
}
