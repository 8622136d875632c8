//! Warnings on standard error.

use crate::complain::complain;
use crate::scene::Scene;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// What this process has said, without the place. A study runs one scene many times, with one override and another, and should
/// say each thing once.
static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

/// Says the warnings of a scene. They come out also where a run is told to be quiet, which spares progress and summary alone.
pub(super) fn say(scene: &Scene) {
    scene.warnings.iter().for_each(|warning| say_one(warning));
}

/// Says a warning that the process has not said yet.
pub(super) fn say_one(warning: &str) {
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    let thing = warning.split_once(": ").map_or(warning, |(_, thing)| thing);
    if said.insert(thing.into()) {
        complain(&format!("lithosph: warning: {warning}"));
    }
}
