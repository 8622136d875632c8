//! All tests of the public library and of the program, in one crate: its folders are those of `src/`. `scenes.rs` is a crate
//! of its own, with a test for each scene and variant.
//!
//! A build without HDF5 has the tests of the program alone: what the library computes does not depend on HDF5, and its
//! passes take a minute to compile.

mod cli;
#[cfg_attr(not(feature = "hdf5"), allow(dead_code))]
mod common;
mod scene;

#[cfg(feature = "hdf5")]
mod backend;
#[cfg(feature = "hdf5")]
mod conservation;
#[cfg(feature = "hdf5")]
mod contact;
#[cfg(feature = "hdf5")]
mod fields;
#[cfg(feature = "hdf5")]
mod material;
#[cfg(feature = "hdf5")]
mod observable;
#[cfg(feature = "hdf5")]
mod obstacle;
#[cfg(feature = "hdf5")]
mod pass;
#[cfg(feature = "hdf5")]
mod run;
#[cfg(feature = "hdf5")]
mod step;
#[cfg(feature = "hdf5")]
mod structure;
#[cfg(feature = "hdf5")]
mod study;
