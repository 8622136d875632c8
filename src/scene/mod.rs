//! Scenes: as typed ([`file`]), then resolved here into particles and numbers. Knows no device.

pub mod anchor;
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
mod mass;
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
mod volume;
pub mod words;

pub use mass::BodyMass;
pub use members::{Particle, Plane, SceneBody, SceneConstraint, SceneFacet, SceneObstacle};
pub use model::Scene;
pub(crate) use resolve::resolve;
