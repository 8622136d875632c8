//! Compares a finished run with what its scene expects.
//!
//! A row of the table states one of four things ([`Statement`]): the truth comes out; the method fails as its source says; this
//! program misses a known truth; nothing is known, and what was seen is held. It holds, and so stays a pass, a failure, a
//! shortfall or a pin, or it is a miss.

mod distance;
mod measure;
mod record;
mod table;
mod width;

pub use measure::{error, fraction, number};
pub use record::Record;
pub use table::text;
pub use width::typed_too_wide;

use crate::run::Finished;
use crate::scene::Scene;
use crate::scene::file::{Expect, File, Statement};
use distance::reference;
use measure::{Compared, compare};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// How a comparison came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    Pass,
    Miss,
    /// The method fails as its source says.
    Failure,
    /// This program misses the truth by as much as the scene says.
    Shortfall,
    /// What was seen before is seen again.
    Pinned,
    /// The run took longer than it was given, or this machine has no room for it: nothing was compared.
    Unfinished,
}

/// One line of the table.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Row {
    pub scene: String,
    /// Whether the scene is left out where only quick ones are asked for.
    pub slow: bool,
    pub name: String,
    /// The run's number; of a curve its distance from the reference. None where there is no finite one.
    pub seen: Option<f64>,
    /// The truth.
    pub expected: String,
    /// What was seen less the truth, as a fraction of what `of` says; none where there is no truth.
    pub error: Option<f64>,
    pub of: String,
    pub tolerance: String,
    pub source: String,
    pub verdict: Verdict,
    /// Why another number may come out than the truth, or on which side a miss lies.
    pub note: String,
    /// Why the tolerance hides more than it should.
    pub wide: Option<String>,
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

/// Reads every reference that a scene names, so that a missing one shows before the run.
pub fn references(file: &File, folder: &Path) -> Result<(), String> {
    let named = file.expect.values().filter_map(|expect| Some((expect.reference.as_ref()?, expect)));
    named.into_iter().try_for_each(|(name, expect)| reference(&folder.join(name), expect).map(|_| ()))
}

/// The line of a run that did not come to its end: a miss, or unfinished.
pub fn failed(scene: &Scene, reason: String, verdict: Verdict) -> Row {
    Row {
        scene: scene.label(),
        slow: !scene.file.ci,
        name: "run".into(),
        seen: None,
        expected: "an end".into(),
        error: None,
        of: String::new(),
        tolerance: String::new(),
        source: reason,
        verdict,
        note: String::new(),
        wide: None,
    }
}

fn row(scene: &Scene, finished: &Finished, folder: &Path, name: &str, expect: &Expect) -> Result<Row, String> {
    let found = compare(scene, finished, folder, name, expect)?;
    let holds = holds(&found, expect);
    let verdict = match (holds, expect.kind) {
        (false, _) => Verdict::Miss,
        (true, Statement::Truth) => Verdict::Pass,
        (true, Statement::Failure) => Verdict::Failure,
        (true, Statement::Shortfall) => Verdict::Shortfall,
        (true, Statement::Pinned) => Verdict::Pinned,
    };
    let because = expect.because.clone().unwrap_or_default();
    Ok(Row {
        scene: scene.label(),
        slow: !scene.file.ci,
        name: name.into(),
        seen: Some(found.number).filter(|number| number.is_finite()),
        expected: table::expected(expect),
        error: found.error.map(|error| error / found.scale).filter(|error| error.is_finite()),
        of: if found.error.is_some() { found.of.clone() } else { String::new() },
        tolerance: table::tolerance(expect),
        source: expect.source.clone(),
        verdict,
        note: if holds { because } else { format!("{because}{}", side(&found, expect)) },
        wide: width::too_wide(&found, expect),
    })
}

/// Whether the number lies where the expectation has it. NaN lies nowhere.
fn holds(found: &Compared, expect: &Expect) -> bool {
    if let Some([low, high]) = expect.between {
        return (low..=high).contains(&found.number);
    }
    let allowed = expect.tolerance.unwrap_or(0.0);
    match (expect.kind, found.error) {
        (Statement::Truth, Some(error)) => error.abs() / found.unit <= allowed,
        _ => (found.number - expect.seen.unwrap_or(f64::NAN)).abs() / found.unit_of_seen <= allowed,
    }
}

/// On which side of its window a number lies that misses a known error.
fn side(found: &Compared, expect: &Expect) -> &'static str {
    let known = match (expect.seen, expect.value) {
        (Some(seen), _) if expect.reference.is_some() => seen * found.unit,
        (Some(seen), Some(value)) => seen - value,
        _ => return "",
    };
    match found.error {
        Some(error) if error.abs() < known.abs() => "; nearer to the truth than it was: say so in the scene",
        Some(error) if error.abs() > known.abs() => "; farther from the truth than it was",
        _ => "",
    }
}
