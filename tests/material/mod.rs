//! The laws of the Total Lagrangian formulation, on one element.

mod j2;
mod laws;
mod maxwell;
mod strengths;
