//! The formulations that know where particles began. One crate, so that the passes are compiled once for all of it.

mod buckling;
mod choice;
#[path = "../common/mod.rs"]
mod common;
mod material;
mod maxwell;
mod moment;
mod operators;
mod patches;
mod plasticity;
mod quasi_static;
mod shape_block;
mod shape_functions;
mod surfaces;
