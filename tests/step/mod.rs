//! What a method is made of, and what its steps give beside exact answers.

mod body_options;
mod corrected_kernel;
mod elastic;
pub mod eulerian;
mod groups;
mod lagrangian;
mod tied;
