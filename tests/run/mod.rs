//! Whole runs: equilibrium, energy, faults, and going on after a kill.

mod checkpoint;
mod crossing;
#[cfg(feature = "hdf5")]
mod damage;
mod fault;
mod quasi_static;
mod watch;
