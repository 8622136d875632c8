//! Whole runs: equilibrium, and going on after a kill.

#[cfg(feature = "hdf5")]
mod checkpoint;
mod quasi_static;
