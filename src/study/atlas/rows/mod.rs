//! The rows, by what fails in them.

mod compression;
mod contact;
mod fracture;
mod kernels;
mod material;
mod measures;
mod precision;
mod rotation;
mod tension;
mod time_step;

use super::Row;

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
    &contact::STEPS,
    &contact::ZONES,
    &contact::NORMALS,
    &rotation::FILTER,
    &rotation::GRADIENT,
    &kernels::SUMMATION,
    &kernels::ENERGY,
    &kernels::DISORDER_GROWS,
    &time_step::LEAPFROG,
    &time_step::SSP_RK3,
    &time_step::RK4,
    &time_step::PEFRL,
    &time_step::RK2,
    &precision::STAGNATION,
    &precision::DIGITS,
    &material::COLLAPSE,
];
