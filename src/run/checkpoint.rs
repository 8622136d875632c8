//! What a run needs to go on with the same bits: the carried fields in their order, time and step, and what it has seen so far.

use super::summary::StepLengths;
use crate::backend::{Backend, Saved};
use crate::output::manifest::Content;
use crate::rows::Clock;
use crate::scene::Scene;

/// Its file, and where the one before goes.
pub const NAME: &str = "checkpoint.h5";
pub const PREVIOUS: &str = "checkpoint.previous.h5";

/// A stored state.
pub struct Checkpoint {
    /// Events that are done.
    pub event: usize,
    pub time: f64,
    pub steps: u32,
    /// What the watch over the energy has seen: see `Watch::save`.
    pub watch: Vec<f64>,
    pub name: String,
    pub variant: Option<String>,
    /// Scene as resolved, and device, that made it.
    pub scene: String,
    pub device: String,
    /// The carried fields of each group of particles.
    pub groups: Vec<Saved>,
    pub story: Story,
}

/// What a run has counted and said, so that its summary is that of an unbroken one.
#[derive(Debug, Clone, Default)]
pub struct Story {
    /// The clocks of the machine's members.
    pub clocks: Vec<Clock<f64>>,
    pub lists: u32,
    pub lengths: StepLengths,
    pub warnings: Vec<String>,
    /// Pairs of bodies whose meeting was told.
    pub told: Vec<[String; 2]>,
    /// See `Balance::save`.
    pub balance: Vec<f64>,
    /// Mean number of neighbours; none but at the end of the run.
    pub neighbors: Option<f64>,
    /// Seconds of wall and of processor time.
    pub spent: [f64; 2],
    /// The series up to here.
    pub series: Option<Content>,
    /// Frames up to here: number, time and step.
    pub frames: Vec<(u32, f64, u64)>,
}

impl Checkpoint {
    pub fn new(scene: &Scene, backend: &dyn Backend, (event, time, steps): (usize, f64, u32), groups: Vec<Saved>) -> Self {
        let (name, variant, scene) = (scene.name.clone(), scene.variant.clone(), scene.text.clone());
        let (device, story) = (backend.describe(), Story::default());
        Self { event, time, steps, watch: Vec::new(), name, variant, scene, device, groups, story }
    }

    /// Refuses a checkpoint of another scene, which could not give the same bits.
    pub fn check_scene(&self, scene: &Scene) -> Result<(), String> {
        if self.scene == scene.text {
            return Ok(());
        }
        Err("the checkpoint is of another scene, variant or setting than the run.toml beside it".into())
    }

    /// Refuses a checkpoint of another device, as [`Self::check_scene`].
    pub fn check_device(&self, backend: &dyn Backend) -> Result<(), String> {
        let device = backend.describe();
        // The number of threads does not change the result.
        let kind = |text: &str| text.split(", ").filter(|part| !part.ends_with("threads")).collect::<Vec<_>>().join(", ");
        if kind(&self.device) != kind(&device) {
            return Err(format!("the checkpoint was made on `{}`, this is `{device}`: choose the same backend", self.device));
        }
        Ok(())
    }
}

#[cfg(feature = "hdf5")]
mod stored;

#[cfg(feature = "hdf5")]
pub use stored::read;

#[cfg(not(feature = "hdf5"))]
impl Checkpoint {
    /// A build without HDF5 keeps no checkpoints.
    pub fn put<T>(self, _: impl FnOnce(&[&[u8]]) -> Result<T, String>) -> Result<Option<T>, String> {
        Ok(None)
    }
}

#[cfg(not(feature = "hdf5"))]
pub fn read(_: &std::path::Path) -> Result<Checkpoint, String> {
    Err("this build has no HDF5 and so keeps no checkpoints".into())
}
