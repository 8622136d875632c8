//! The GPU beside its twins, and the shaders that it runs.

mod mirror;
mod parity;
mod precision;
mod shaders;
