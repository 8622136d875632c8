//! Scenes: as typed ([`file`]), then resolved here into particles and numbers. Knows no device.

mod carve;
mod check;
mod clip;
mod contacts;
mod copies;
mod corrected_kernel;
mod cost;
pub mod facets;
pub mod file;
mod groups;
pub mod material;
mod members;
mod model;
mod motion;
mod neighbors;
pub mod packing;
mod parts;
mod plasticity;
mod quasi_static;
pub mod read;
mod refuse;
mod resolve;
mod section;
pub mod shape;
mod state;
pub mod study;
mod surfaces;
mod ties;
mod words;

pub use members::{Particle, Plane, SceneBody, SceneConstraint, SceneFacet, SceneObstacle};
pub use model::Scene;
pub(crate) use resolve::resolve;
