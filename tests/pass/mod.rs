//! What the discrete operators must do exactly.

mod declarations;
pub mod lagrangian;
mod shape_block;
mod shape_functions;
mod strain_rate;
mod stress;
pub mod tied;
