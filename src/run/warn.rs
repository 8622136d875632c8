//! Warnings on standard error.

use crate::backend::frequency;
use crate::complain::complain;
use crate::scene::Scene;
use crate::scene::interval::ROUNDING;
use crate::scene::words::rounded;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// What this process has said, without the place. A study runs one scene many times, with one override and another, and should
/// say each thing once.
static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

/// Says warnings. They come out also where a run is told to be quiet, which spares progress and summary alone.
pub(super) fn say(warnings: &[String]) {
    warnings.iter().for_each(|warning| say_one(warning));
}

/// What there is to warn of before a run: what the scene gave reason for, and a fixed step that no run bears. Takes as long as
/// some steps where the step is fixed, and the memory of the tables in f64: it is asked before the run's own are made.
pub(super) fn of(scene: &Scene) -> Vec<String> {
    scene.warnings.iter().cloned().chain(fixed_step(scene)).collect()
}

fn fixed_step(scene: &Scene) -> Option<String> {
    let (step, unit) = (scene.file.time.step?, scene.unit_names()[2]);
    let place = scene.place(&["time", "step"]);
    let (longest, limit) = frequency::longest_step(scene)?;
    if step > longest {
        return Some(format!(
            "{place}: the fixed time.step of {} {unit} is {} times as long as what {limit}, {} {unit}: the run gains energy out of \
             nothing until it breaks; leave time.step out, and time.cfl finds one, or take less",
            rounded(step, 4),
            rounded(step / longest, 3),
            rounded(longest, 3)
        ));
    }
    let rows = [scene.file.rows(), scene.file.frames()].into_iter().filter(|&time| time > 0.0).fold(f64::INFINITY, f64::min);
    (step > rows * (1.0 + ROUNDING)).then(|| {
        format!(
            "{place}: the fixed time.step of {} {unit} is longer than the {} {unit} between outputs, and each is cut to end at one",
            rounded(step, 4),
            rounded(rows, 4)
        )
    })
}

/// Says a warning that the process has not said yet.
pub(super) fn say_one(warning: &str) {
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    let thing = warning.split_once(": ").map_or(warning, |(_, thing)| thing);
    if said.insert(thing.into()) {
        complain(&format!("lithosph: warning: {warning}"));
    }
}
