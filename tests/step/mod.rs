//! What a method is made of, and what its steps give beside exact answers.

mod corrected_kernel;
mod elastic;
mod eulerian;
mod lagrangian;
