//! Whether a run is within tolerance, and so what a scene needs.

use super::measure::Expected;
use super::piece::Sort;
use crate::study::accuracy::row::{OK, Row};

/// What a piece turned out to be.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Without the piece no observable changes.
    Idle,
    /// Without the piece observables change, but all that is expected stays within tolerance.
    Spare,
    /// Without the piece this expectation or observable leaves its tolerance.
    Needed(String),
    /// Nothing is known, and why: the scene cannot be without the piece, the run failed, or something can no longer be judged.
    Untold(String),
}

impl Verdict {
    /// Whether the scene may be without the piece.
    pub fn may_go(&self) -> bool {
        matches!(self, Verdict::Idle | Verdict::Spare)
    }

    pub fn text(&self, sort: Sort) -> String {
        match (self, sort) {
            (Verdict::Idle, Sort::Named) => "not needed: changes nothing".into(),
            (Verdict::Spare, Sort::Named) => "not needed: within tolerance".into(),
            (Verdict::Idle | Verdict::Spare, Sort::Reduced) => "enough: within tolerance".into(),
            (Verdict::Needed(name), Sort::Named) => format!("needed: {name} leaves its tolerance"),
            (Verdict::Needed(name), Sort::Reduced) => format!("too little: {name} leaves its tolerance"),
            (Verdict::Untold(reason), _) => reason.clone(),
        }
    }
}

/// A change of an observable, over its scale, up to this one counts as no change.
const NOTHING: f64 = 1e-6;
/// A reduced run still counts as no more costly if it takes up to this many times the processor time, since times on a shared
/// machine scatter.
const LONGER: f64 = 1.25;
/// The same factor for particle-updates, which are the same on every machine.
const MORE: f64 = 1.02;

/// Tolerances, and the run of the whole scene.
#[derive(Debug, Clone)]
pub struct Judge {
    pub expected: Vec<Expected>,
    /// Observables that have a number.
    pub observed: Vec<String>,
    /// A fraction for all errors that have a scale, in place of the scene's tolerances.
    pub error: Option<f64>,
    pub whole: Row,
}

/// Numbers of a row for each expectation, and for each observable.
pub const EXPECTED: usize = 2;
pub const OBSERVED: usize = 3;

impl Judge {
    /// Each name that is judged with its number over what is tolerated; none where the run has none.
    pub fn scores(&self, row: &Row) -> Vec<(&str, Option<f64>)> {
        if self.expected.is_empty() {
            let score = |k: usize| Some(self.observable(row, k)[2]? / self.error?);
            return self.observed.iter().enumerate().map(|(k, name)| (name.as_str(), score(k))).collect();
        }
        self.expected.iter().enumerate().map(|(k, expected)| (expected.name.as_str(), self.score(k, expected, row))).collect()
    }

    fn score(&self, k: usize, expected: &Expected, row: &Row) -> Option<f64> {
        let (number, fraction) = (row.errors[EXPECTED * k]?, row.errors[EXPECTED * k + 1]);
        let Some(allowed) = self.error else { return Some(expected.score(number)) };
        match (fraction, expected.is_error()) {
            (Some(fraction), _) => Some(fraction.abs() / allowed),
            (None, true) => Some(expected.score(number)),
            // What has no truth is held to the whole scene's.
            (None, false) => {
                let whole = self.whole.errors[EXPECTED * k]?;
                let width = match (expected.expect.between, expected.expect.seen) {
                    (Some([low, high]), _) => 0.5 * (high - low),
                    (None, seen) => seen.map_or(0.0, f64::abs),
                };
                let gap = (number - whole).abs();
                Some(if gap == 0.0 { 0.0 } else { gap / (allowed * whole.abs().max(width)) })
            }
        }
    }

    /// The worst score with its name, each over that of the whole scene where that itself is beyond its tolerance.
    /// `None` where something cannot be judged.
    pub fn worst(&self, row: &Row) -> Option<(String, f64)> {
        let whole = self.scores(&self.whole);
        let mut worst = (String::new(), 0.0);
        for ((name, score), (_, of_whole)) in self.scores(row).into_iter().zip(whole) {
            let share = score? / of_whole.unwrap_or(0.0).max(1.0);
            // NaN is beyond any tolerance.
            let share = if share.is_nan() { f64::INFINITY } else { share };
            if worst.0.is_empty() || share > worst.1 {
                worst = (name.to_string(), share);
            }
        }
        Some(worst)
    }

    /// The observable that changed most over its scale.
    pub fn largest_change(&self, row: &Row) -> Option<(&str, f64)> {
        let changes = self.observed.iter().enumerate().filter_map(|(k, name)| Some((name.as_str(), self.observable(row, k)[2]?)));
        changes.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Number of an expectation.
    pub fn expectation(&self, row: &Row, k: usize) -> Option<f64> {
        row.errors[EXPECTED * k]
    }

    /// Number, change and relative change of an observable.
    pub fn observable<'a>(&self, row: &'a Row, k: usize) -> &'a [Option<f64>] {
        let first = EXPECTED * self.expected.len() + OBSERVED * k;
        &row.errors[first..first + OBSERVED]
    }

    pub fn verdict(&self, row: &Row) -> Verdict {
        match self.worst(row) {
            None if row.status == OK => Verdict::Untold("not judged: an observable falls away".into()),
            None => Verdict::Untold(row.status.clone()),
            Some((name, share)) if share > 1.0 => Verdict::Needed(name),
            Some(_) if self.largest_change(row).is_none_or(|(_, change)| change <= NOTHING) => Verdict::Idle,
            Some(_) => Verdict::Spare,
        }
    }

    /// Whether a run costs no more than the whole scene's; physics may go even if a noisy clock tells nothing.
    pub fn is_cheaper(&self, sort: Sort, row: &Row) -> bool {
        let (Some(own), Some(whole)) = (row.cost, self.whole.cost) else { return false };
        own[UPDATES] <= MORE * whole[UPDATES] && (sort == Sort::Named || own[CPU] <= LONGER * whole[CPU])
    }

    /// What a run saves of processor time, particle-updates and bytes, as parts of the whole scene's.
    pub fn saved(&self, row: &Row) -> Option<[f64; 3]> {
        let (own, whole) = (row.cost?, self.whole.cost?);
        Some([CPU, UPDATES, BYTES].map(|k| 1.0 - own[k] / whole[k]))
    }
}

/// Places in [`crate::study::accuracy::row::COST`].
pub const UPDATES: usize = 3;
pub const CPU: usize = 4;
pub const BYTES: usize = 6;
