//! The GPU beside its twins, and the shaders that it runs.

mod frequency;
mod mirror;
pub mod parity;
mod precision;
pub mod shaders;
mod units;
