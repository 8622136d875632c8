//! Measures of more than one row.

use crate::study::atlas::Measure;

/// How far particles have come together.
pub const NEAREST: Measure =
    Measure { about: "least distance of two particles at the end, in spacings", of: |run| run.last("nearest") };

/// How far a kick has grown.
pub const GROWTH: Measure =
    Measure { about: "largest speed over that of the kick", of: |run| Ok(run.most("speed")? / run.first("speed")?) };
