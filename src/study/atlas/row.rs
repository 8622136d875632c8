//! A row of the atlas: what fails, what mends it, and what tells one from the other.

use super::outcome::Outcome;
use super::side::{Side, Size};
use crate::output::csv::shortest;
use crate::run::Stop;
use std::path::Path;

/// A known failure, its remedy, and what tells one from the other.
#[derive(Debug)]
pub struct Row {
    /// Its word on the command line.
    pub name: &'static str,
    /// What goes wrong and what mends it.
    pub failure: &'static str,
    pub source: &'static str,
    pub plain: Side,
    pub remedy: Side,
    pub measure: Measure,
    pub fails: Bound,
    pub survives: Bound,
    /// Series charted for both runs, if any.
    pub trace: Option<Trace>,
    /// Overrides of both runs that make them short enough for a test; none where they are.
    pub small: &'static [&'static str],
}

/// The number that a row is judged by.
#[derive(Debug, Clone, Copy)]
pub struct Measure {
    pub about: &'static str,
    pub of: fn(&Outcome) -> Result<f64, String>,
}

/// A range that is open to one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    Above(f64),
    Below(f64),
}

/// A series of both runs over time.
#[derive(Debug, Clone, Copy)]
pub struct Trace {
    pub series: &'static str,
    pub about: &'static str,
    /// Logarithmic ordinate.
    pub log: bool,
}

/// What a row gave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    pub plain: f64,
    pub remedy: f64,
    /// The plain method failed, and the remedy survived.
    pub as_stated: bool,
}

impl Bound {
    pub fn holds(self, number: f64) -> bool {
        match self {
            Self::Above(least) => number > least,
            Self::Below(most) => number < most,
        }
    }

    pub fn text(self) -> String {
        match self {
            Self::Above(least) => format!("> {}", shortest(least)),
            Self::Below(most) => format!("< {}", shortest(most)),
        }
    }
}

impl Row {
    /// Runs both sides into folders within `folder`.
    ///
    /// # Errors
    /// A refused scene, a file that cannot be written, a measure that finds no number, or the user.
    pub fn run(&self, folder: &Path, size: Size, mut tell: impl FnMut(&str)) -> Result<Verdict, Stop> {
        let mut number = |side: &Side, word: &str| {
            tell(word);
            let outcome = side.run(&folder.join(word), size, self.small)?;
            let number = (self.measure.of)(&outcome).map_err(|why| Stop::Failed(format!("{}, {word}: {why}", self.name)))?;
            Ok((number, outcome.stopped.is_some()))
        };
        let ((plain, _), (remedy, broke_off)) = (number(&self.plain, "plain")?, number(&self.remedy, "remedy")?);
        // A remedy that does not come to its end survives nothing, whatever it measured.
        let remedy = if broke_off { f64::NAN } else { remedy };
        Ok(Verdict { plain, remedy, as_stated: self.fails.holds(plain) && self.survives.holds(remedy) })
    }
}
