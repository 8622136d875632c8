//! The rows, by what fails in them.

mod compression;
mod contact;
mod fracture;
mod kernels;
mod material;
mod precision;
mod rotation;
mod tension;
mod time_step;

use super::{Measure, Row};

/// Every row: a line each, in the order of the page.
pub static ROWS: &[&Row] = &[
    &tension::STRIP,
    &tension::LINE,
    &tension::PLANE,
    &tension::SPACING,
    &tension::REST,
    &compression::PAIRING,
    &compression::HOURGLASS,
    &fracture::RINGS,
    &contact::ADHESION,
    &contact::ZONES,
    &contact::NORMALS,
    &rotation::FILTER,
    &rotation::GRADIENT,
    &kernels::ENERGY,
    &time_step::LEAPFROG,
    &time_step::RK2,
    &precision::STAGNATION,
    &precision::DIGITS,
    &material::COLLAPSE,
];

/// How far particles have come together.
const NEAREST: Measure =
    Measure { about: "least distance of two particles at the end, in spacings", of: |run| run.last("nearest") };

/// How far a kick has grown.
const GROWTH: Measure =
    Measure { about: "largest speed over that of the kick", of: |run| Ok(run.most("speed")? / run.first("speed")?) };
