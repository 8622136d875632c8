//! What a run needs to go on with the same bits: the carried fields in their order, time and step.

use crate::backend::{Backend, Saved};
use crate::scene::Scene;
use std::path::Path;

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
}

impl Checkpoint {
    pub fn new(scene: &Scene, backend: &dyn Backend, (event, time, steps): (usize, f64, u32), groups: Vec<Saved>) -> Self {
        let (name, variant, scene) = (scene.name.clone(), scene.variant.clone(), scene.text.clone());
        Self { event, time, steps, watch: Vec::new(), name, variant, scene, device: backend.describe(), groups }
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
mod stored {
    use super::{Checkpoint, Path, Saved};
    use crate::fields::Field;
    use crate::output::vtkhdf::reason;

    /// Where the file has the fields of a group of particles.
    fn place(group: usize) -> String {
        if group == 0 { "fields".into() } else { format!("fields_{group}") }
    }

    impl Checkpoint {
        /// Written aside and renamed, so that the folder always holds a whole one.
        pub fn write(&self, folder: &Path) -> Result<(), String> {
            let (aside, path) = (folder.join("checkpoint.h5.part"), folder.join("checkpoint.h5"));
            self.write_to(&aside).map_err(|e| format!("cannot write {}: {}", path.display(), reason(&e)))?;
            std::fs::rename(&aside, &path).map_err(|e| format!("cannot write {}: {e}", path.display()))
        }

        fn write_to(&self, path: &Path) -> hdf5::Result<()> {
            let file = hdf5::File::create(path)?;
            let numbers = [self.event as f64, self.time, f64::from(self.steps)];
            file.new_dataset_builder().with_data(&numbers).create("progress")?;
            file.new_dataset_builder().with_data(&self.watch).create("watch")?;
            let texts = [("name", Some(&self.name)), ("variant", self.variant.as_ref()), ("scene", Some(&self.scene))];
            for (name, text) in texts.into_iter().chain([("device", Some(&self.device))]) {
                if let Some(text) = text {
                    file.new_dataset_builder().with_data(text.as_bytes()).create(name)?;
                }
            }
            for (k, columns) in self.groups.iter().enumerate() {
                let group = file.create_group(&place(k))?;
                for (field, bytes) in columns {
                    group.new_dataset_builder().with_data(bytes.as_slice()).create(field.name())?;
                }
            }
            file.flush()
        }
    }

    pub fn read(folder: &Path) -> Result<Checkpoint, String> {
        let path = folder.join("checkpoint.h5");
        if !path.exists() {
            return Err(format!("{} holds no checkpoint.h5 to resume from", folder.display()));
        }
        read_from(&path).map_err(|e| format!("cannot read {}: {}", path.display(), reason(&e)))
    }

    fn read_from(path: &Path) -> hdf5::Result<Checkpoint> {
        let file = hdf5::File::open(path)?;
        let progress = file.dataset("progress")?.read_raw::<f64>()?;
        let text = |name: &str| -> hdf5::Result<String> {
            Ok(String::from_utf8_lossy(&file.dataset(name)?.read_raw::<u8>()?).into_owned())
        };
        let mut groups = Vec::new();
        for name in (0..).map(place).take_while(|name| file.link_exists(name)) {
            let group = file.group(&name)?;
            let mut columns = Saved::new();
            for &field in Field::ALL {
                if group.link_exists(field.name()) {
                    columns.insert(field, group.dataset(field.name())?.read_raw::<u8>()?);
                }
            }
            groups.push(columns);
        }
        Ok(Checkpoint {
            event: progress[0] as usize,
            time: progress[1],
            steps: progress[2] as u32,
            watch: if file.link_exists("watch") { file.dataset("watch")?.read_raw::<f64>()? } else { Vec::new() },
            name: text("name")?,
            variant: if file.link_exists("variant") { Some(text("variant")?) } else { None },
            scene: text("scene")?,
            device: text("device")?,
            groups,
        })
    }
}

#[cfg(feature = "hdf5")]
pub use stored::read;

#[cfg(not(feature = "hdf5"))]
impl Checkpoint {
    /// A build without HDF5 keeps no checkpoints.
    pub fn write(&self, _: &Path) -> Result<(), String> {
        Ok(())
    }
}

#[cfg(not(feature = "hdf5"))]
pub fn read(_: &Path) -> Result<Checkpoint, String> {
    Err("this build has no HDF5 and so keeps no checkpoints".into())
}
