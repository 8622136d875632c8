//! Solids by smoothed particle hydrodynamics, on any GPU.

pub mod backend;
pub mod check;
pub mod cli;
pub mod material;
pub mod observable;
pub mod output;
pub mod pair;
pub mod particles;
pub mod pass;
pub mod run;
pub mod scene;
pub mod smoothing;
pub mod state;
pub mod step;
pub mod study;
pub mod tensor;
