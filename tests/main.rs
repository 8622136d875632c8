//! All tests of the public library and of the program, in one crate: its folders are those of `src/`.

mod backend;
mod cli;
mod common;
mod conservation;
mod contact;
mod fields;
mod material;
mod observable;
mod obstacle;
mod pass;
mod run;
mod step;
mod structure;
mod study;
