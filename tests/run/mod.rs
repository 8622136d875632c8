//! Whole runs: equilibrium, energy, faults, and going on after a kill.

mod checkpoint;
mod crossing;
mod fault;
mod quasi_static;
mod watch;
