//! Whole runs: equilibrium, and going on after a kill.

mod checkpoint;
mod quasi_static;
