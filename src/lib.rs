//! Solids by smoothed particle hydrodynamics, on any GPU.
//!
//! # A walk: the stress of one particle through the files
//!
//! 1. A scene file names a body, a material and a formulation. [`scene::file`] is that file as a set of structs;
//!    [`scene::read`] merges variants and overrides into it and knows the line of every word;
//!    [`scene::Scene`] is what comes out: particles with a place, a volume and a velocity, and the
//!    [`method::Method`], the list of physics and numerics that this scene names.
//! 2. [`step::fields`] says which columns the method needs, those that its passes declare ([`pass::Declaration`]):
//!    `deviatoric_stress` exists only if some material resists shear. The columns are [`fields::Columns`], one list of
//!    tables of particles, facets, bonds, contacts and cells for host, device and files.
//! 3. [`step::step`] is one time step as a list of passes. In leapfrog our particle's velocity is kicked
//!    ([`pass::Pass::Kick`]), it drifts half a step, and there, with position and velocity both at the half
//!    step, [`pass::Pass::StrainRate`] sums the velocity gradient over the neighbours in its list.
//! 4. [`pass::Pass::Stress`] turns that gradient into stress: Jaumann's rate with an exact rotation, Hooke's
//!    law from [`material`], and the return to the yield surface where a body yields.
//! 5. [`pass::Pass::SpecificStress`] brings it into the form that forces are summed in, and
//!    [`pass::Pass::Force`] sums them, with viscosity and artificial stress where the scene names them.
//!
//!    In the Total Lagrangian formulation the list is made once, where the particles were at the start
//!    ([`step::prepare`]); [`pass::Pass::Deform`] finds the deformation gradient and the law's stress, and
//!    [`pass::Pass::BondForce`] sums what the bonds carry of it, the derivative of an energy.
//! 6. Every pass exists twice under one name: `shaders/pass/x.wgsl` and `src/pass/x.rs`. [`backend::gpu`] runs
//!    the first in f32 with the state resident on the device; [`backend::cpu`] runs the second in f64 on all
//!    cores. [`backend::shader`] composes the text of the first and reads its bindings back, from the parts of
//!    [`registry`] that the method names and no others.
//! 7. At an output the run loop ([`run`]) fetches the fields that the scene's observables read, and no others;
//!    [`observable`] makes numbers of them, [`output`] files and pictures, [`check`] verdicts.
//!
//! # What is deliberately absent
//!
//! Files import each other in no large circle: [`method`] and [`rows`], the words and the numbers of a run, lie below
//! everything that reads them. `ARCHITECTURE.md` has the layers and says where a new thing goes.
//!
//! A pass writes to particle (cell, block) i only. There are no float atomics: the same run gives the same bits
//! on the same device. [`scene`] knows no device, observables never touch one, and the host never waits inside
//! the step loop.

pub mod backend;
pub mod bond;
pub mod check;
pub mod cli;
mod complain;
pub mod contact;
pub mod facet;
pub mod fields;
pub mod material;
pub mod memory;
pub mod method;
pub mod observable;
pub mod obstacle;
mod open;
pub mod output;
pub mod pair;
pub mod pass;
pub mod registry;
pub mod rows;
pub mod run;
pub mod scene;
pub mod shape_function;
pub mod smoothing;
pub mod state;
pub mod step;
pub mod study;
pub mod tensor;
