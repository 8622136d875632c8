//! The Total Lagrangian formulation. One crate, so that the passes are compiled once for all of it.

mod buckling;
#[path = "../common/mod.rs"]
mod common;
mod material;
mod maxwell;
mod moment;
mod operators;
mod patches;
mod quasi_static;
