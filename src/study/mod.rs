//! Theory and sweeps that runs are compared with.

pub mod ablate;
pub mod accuracy;
pub mod atlas;
pub mod buckling;
pub mod chart;
pub mod cost;
pub mod eigen;
pub mod stability;
pub mod sweep;
pub mod tensile;
pub mod von_neumann;
