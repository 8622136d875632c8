//! The word for where a study runs.

use crate::backend::Choice;
use clap::ValueEnum;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum PlaceWord {
    /// The CPU path in f64.
    Cpu,
    /// The CPU path in f32.
    Cpu32,
    /// Any adapter, a software one too.
    Gpu,
}

impl PlaceWord {
    pub fn choice(self) -> Choice {
        match self {
            Self::Cpu => Choice::Cpu,
            Self::Cpu32 => Choice::Cpu32,
            Self::Gpu => Choice::Gpu(None),
        }
    }
}
