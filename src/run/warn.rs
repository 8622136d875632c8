//! Warnings on standard error.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// What this process has said, without the place. A study runs one scene many times, with one override and another, and should
/// say each thing once.
static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

/// Says warnings. They come out also where a run is told to be quiet, which spares progress and summary alone.
pub(super) fn say(warnings: &[String]) {
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    for warning in warnings {
        let thing = warning.split_once(": ").map_or(warning.as_str(), |(_, thing)| thing);
        if said.insert(thing.to_string()) {
            eprintln!("lithosph: warning: {warning}");
        }
    }
}
