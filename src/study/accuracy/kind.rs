//! How the distance of a run from what is expected becomes one number.

use crate::scene::file::Norm;

/// Errors as fractions: of the largest number of a reference, of the expected value, or where that is 0 of the largest
/// number of the run's own series.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum ErrorKind {
    /// The largest distance from the reference.
    Max,
    /// The root of its mean square.
    Rms,
    /// The distance at the end.
    Final,
    /// The error of the period, over at least two.
    Phase,
    /// The distance from a value.
    Fraction,
}

impl ErrorKind {
    /// As a column begins.
    pub fn word(self) -> &'static str {
        match self {
            Self::Max => "max",
            Self::Rms => "rms",
            Self::Final => "final",
            Self::Phase => "phase",
            Self::Fraction => "fraction",
        }
    }

    /// In words.
    pub fn about(self) -> &'static str {
        match self {
            Self::Max => "largest error",
            Self::Rms => "rms error",
            Self::Final => "error at the end",
            Self::Phase => "error of the period",
            Self::Fraction => "error",
        }
    }

    /// That of an expectation; `None` where there is a value to compare with.
    pub fn norm(self) -> Option<Norm> {
        match self {
            Self::Max => Some(Norm::Max),
            Self::Rms => Some(Norm::Rms),
            Self::Final => Some(Norm::Final),
            Self::Phase => Some(Norm::Phase),
            Self::Fraction => None,
        }
    }
}
