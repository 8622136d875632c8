//! The output folder of a run: `run.toml`, `series.csv`, `particles.vtkhdf` and `particles/*.vtkhdf`, `frames/*.png`,
//! `summary.json`, `checkpoint.h5` and the one before it, and `manifest.txt`, the list of them.
//!
//! What is finished is never written again. A run that goes on finds what it wrote after its checkpoint, makes the same bytes
//! again and leaves the files as they are; only where it takes another course are they replaced.

mod found;
mod names;
mod own;

pub use found::{Known, find};

#[cfg(feature = "hdf5")]
use names::PARTICLES;
use names::{Frame, SERIES, SUMMARY, picture_name};

use super::checkpoint::{self, Checkpoint};
use super::{Finished, Options, Stop};
use crate::backend::Choice;
use crate::fields::Field;
use crate::observable::{Moment, Observer, Table, Value};
use crate::output::csv::{self, Series};
use crate::output::lock::Lock;
use crate::output::manifest::{Content, Manifest};
use crate::output::{self, Painter, Snapshot, View, durable};
use crate::scene::Scene;
use serde_json::json;
use std::fs;
use std::path::{Path, PathBuf};

/// An open output folder.
pub struct Files {
    pub folder: PathBuf,
    manifest: Manifest,
    series: Option<Series>,
    /// Frames of this run up to now.
    frames: Vec<Frame>,
    /// What `particles.vtkhdf` refers to: after a kill it may be ahead of the run.
    listed: Vec<Frame>,
    /// Numbers of frames whose particles were damaged.
    lost: Vec<u32>,
    /// Whether `checkpoint.h5` is good, so that it becomes the one before.
    keep_checkpoint: bool,
    painter: Painter,
    /// Let go of last.
    _lock: Lock,
}

/// Where a scene's output goes unless told otherwise.
pub fn folder(scene: &Scene) -> PathBuf {
    Path::new("out").join(scene.label())
}

/// Quantities stored beside displacement and velocity, and the one painted.
fn quantities(scene: &Scene) -> Vec<String> {
    let mut list: Vec<String> = ["displacement", "velocity"].map(String::from).to_vec();
    let painted = scene.file.output.picture.field.split('.').next().unwrap_or_default().to_string();
    for name in scene.file.output.fields.iter().cloned().chain([painted, "body".to_string()]) {
        if !list.contains(&name) {
            list.push(name);
        }
    }
    list
}

/// Fields that a frame needs.
pub fn fields_stored(scene: &Scene) -> Vec<Field> {
    let mut list = vec![Field::Number];
    list.extend(quantities(scene).iter().flat_map(|q| crate::observable::fields_of_path(scene, q)));
    list
}

/// Refuses to overwrite a run unless forced.
pub fn refuse_existing(scene: &Scene, options: &Options) -> Result<(), String> {
    let folder = options.out.clone().unwrap_or_else(|| folder(scene));
    if folder.exists() && !options.force { Err(exists(&folder)) } else { Ok(()) }
}

fn exists(folder: &Path) -> String {
    format!("{} exists already; --force overwrites it, --out names another folder", folder.display())
}

/// Makes the folder of a run; it must be new unless the run is forced.
fn make_folder(folder: &Path, force: bool) -> Result<(), Stop> {
    let failed = |error: std::io::Error| Stop::of_folder(folder, &error);
    fs::create_dir_all(folder.parent().unwrap_or(Path::new(""))).map_err(failed)?;
    match fs::create_dir(folder) {
        // Another run may have made it since we looked.
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists && !force => Err(Stop::Refused(exists(folder))),
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => Ok(()),
        made => made.map_err(failed),
    }
}

impl Files {
    /// Makes the folder, or takes away what a run before wrote to it, and nothing else.
    pub fn create(scene: &Scene, options: &Options) -> Result<Self, Stop> {
        let folder = options.out.clone().unwrap_or_else(|| folder(scene));
        let painter = painter(options).map_err(Stop::Refused)?;
        make_folder(&folder, options.force)?;
        let lock = Lock::take(&folder).map_err(Stop::of)?;
        own::clear(&folder)?;
        let about = json!({ "scene": scene.name, "variant": scene.variant, "warnings": scene.warnings }).to_string();
        let mut manifest = Manifest::create(&folder, &about).map_err(Stop::Failed)?;
        manifest.put("run.toml", &[scene.text.as_bytes()]).map_err(Stop::Failed)?;
        Self::open(folder, manifest, lock, painter).map_err(Stop::Failed)
    }

    fn open(folder: PathBuf, manifest: Manifest, lock: Lock, painter: Painter) -> Result<Self, String> {
        for name in ["frames", "particles"].into_iter().take(if cfg!(feature = "hdf5") { 2 } else { 1 }) {
            let path = folder.join(name);
            fs::create_dir_all(&path).map_err(|error| durable::failed(&path, &error))?;
        }
        let (frames, listed, lost) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { folder, manifest, series: None, frames, listed, lost, keep_checkpoint: true, painter, _lock: lock })
    }

    /// Opens a run's folder again, as it was found; gives the series up to the checkpoint.
    pub fn reopen(options: &Options, folder: PathBuf, known: Known) -> Result<(Self, Table), Stop> {
        let painter = painter(options).map_err(Stop::Refused)?;
        let mut files = Self::open(folder, known.manifest, known.lock, painter).map_err(Stop::Failed)?;
        (files.lost, files.listed, files.keep_checkpoint) = (known.lost, known.listed, known.keep_checkpoint);
        if let Some(saved) = &known.saved {
            files.frames.clone_from(&saved.story.frames);
        }
        #[cfg(feature = "hdf5")]
        if !files.frames.is_empty() && !files.listed.starts_with(&files.listing()) {
            files.relist().map_err(Stop::Failed)?;
        }
        let mut table = Table::default();
        if let Some((series, (names, rows))) = known.series {
            table.times = rows.iter().map(|row| row[0]).collect();
            for (k, name) in names.iter().enumerate().skip(1) {
                table.columns.insert(name.clone(), rows.iter().map(|row| row[k]).collect());
            }
            files.series = Some(series);
        }
        Ok((files, table))
    }

    /// Writes the last row of the table.
    pub fn row(&mut self, time: f64, observers: &[Observer], table: &Table) -> Result<(), String> {
        let names: Vec<&String> = series_names(observers);
        let series = match &mut self.series {
            Some(series) => series,
            none => {
                let header: Vec<String> = std::iter::once("time".to_string()).chain(names.iter().map(|n| (*n).clone())).collect();
                // Before the first checkpoint tells how long it is, the file is known by its header.
                let line = csv::text(&header, [])?;
                self.manifest.note(SERIES, Content::of(&[line.as_bytes()]))?;
                none.insert(Series::begin(&self.folder.join(SERIES), &header)?)
            }
        };
        let last = |name: &&String| table.columns[*name].last().copied().unwrap_or(f64::NAN);
        series.row(&std::iter::once(time).chain(names.iter().map(last)).collect::<Vec<_>>())
    }

    /// Stores and paints a moment; gives the picture's place in the folder.
    pub fn frame(&mut self, scene: &Scene, moment: &Moment) -> Result<String, String> {
        let snapshot = moment.snapshot(&quantities(scene));
        let number = self.frames.last().map_or(0, |last| last.0 + 1);
        let frame = (number, snapshot.time, snapshot.step);
        self.particles(frame, &snapshot)?;
        let mut view = view(scene);
        if scene.file.output.picture.bounds.is_none() {
            view.bounds = view.bounds.map(|first| output::follow(first, &snapshot));
        }
        let picture = self.painter.paint(&snapshot, &view)?;
        let place = picture_name(number);
        self.manifest.put(&place, &[&output::png(&picture)?])?;
        if self.frames.last() != Some(&frame) {
            self.frames.push(frame);
        }
        Ok(place)
    }

    #[cfg(not(feature = "hdf5"))]
    #[expect(clippy::unnecessary_wraps, reason = "a build with HDF5 writes them")]
    fn particles(&mut self, _: Frame, _: &Snapshot) -> Result<(), String> {
        Ok(())
    }

    /// Puts the particles of a frame into their file, and the file on the master's list.
    #[cfg(feature = "hdf5")]
    fn particles(&mut self, frame: Frame, snapshot: &Snapshot) -> Result<(), String> {
        use crate::output::vtkhdf;
        let (name, bytes) = (vtkhdf::frame_name(frame.0), vtkhdf::frame(snapshot)?);
        let stays = self.listed.contains(&frame) && durable::holds(&self.folder.join(&name), &[&bytes]);
        if !stays && self.listed.iter().any(|listed| listed.0 >= frame.0) {
            // The run takes another course than before it was broken off: nobody shall read frames of both.
            let old = std::mem::take(&mut self.listed);
            self.list(&vtkhdf::Shape::of(snapshot), self.listing())?;
            for (number, ..) in old.into_iter().filter(|old| old.0 > frame.0) {
                let _ = fs::remove_file(self.folder.join(vtkhdf::frame_name(number)));
                let _ = fs::remove_file(self.folder.join(picture_name(number)));
            }
        }
        self.manifest.put(&name, &[&bytes])?;
        self.frames.push(frame);
        if stays {
            return Ok(());
        }
        self.list(&vtkhdf::Shape::of(snapshot), self.listing())
    }

    /// Frames of this run whose particles are there.
    #[cfg(feature = "hdf5")]
    fn listing(&self) -> Vec<Frame> {
        self.frames.iter().filter(|frame| !self.lost.contains(&frame.0)).copied().collect()
    }

    /// Lets the master refer to some frames.
    #[cfg(feature = "hdf5")]
    fn list(&mut self, shape: &output::vtkhdf::Shape, frames: Vec<Frame>) -> Result<(), String> {
        let kept = |&(number, time, step): &Frame| output::vtkhdf::Kept { number, time, step };
        let bytes = output::vtkhdf::master(shape, &frames.iter().map(kept).collect::<Vec<_>>())?;
        self.listed = frames;
        self.manifest.put(PARTICLES, &[&bytes])
    }

    /// Writes a master anew that is damaged, or refers to a frame that is.
    #[cfg(feature = "hdf5")]
    fn relist(&mut self) -> Result<(), String> {
        let frames = self.listing();
        let Some(first) = frames.first() else { return Ok(()) };
        let shape = output::vtkhdf::shape(&self.folder.join(output::vtkhdf::frame_name(first.0)))?;
        self.list(&shape, frames)
    }

    /// Keeps a state to go on from, when all that was written up to it is on the disk.
    pub fn checkpoint(&mut self, mut saved: Checkpoint) -> Result<(), String> {
        if let Some(series) = &mut self.series {
            let content = series.sync()?;
            self.manifest.note(SERIES, content)?;
            saved.story.series = Some(content);
        }
        saved.story.frames.clone_from(&self.frames);
        let (path, previous) = (self.folder.join(checkpoint::NAME), self.folder.join(checkpoint::PREVIOUS));
        let (manifest, keep) = (&mut self.manifest, self.keep_checkpoint && path.exists());
        let put = saved.put(|parts| {
            if let Some(&before) = manifest.contents(checkpoint::NAME).last().filter(|_| keep) {
                manifest.note(checkpoint::PREVIOUS, before)?;
            }
            manifest.note(checkpoint::NAME, Content::of(parts))?;
            manifest.sync()?;
            if keep { durable::put_and_keep(&path, parts, &previous) } else { durable::put(&path, parts) }
        })?;
        self.keep_checkpoint |= put.is_some();
        Ok(())
    }

    /// Summary and profiles.
    pub fn finish(&mut self, scene: &Scene, finished: &Finished) -> Result<(), String> {
        if let Some(series) = &mut self.series {
            series.cut()?;
        }
        for (name, rows) in &finished.profiles {
            let header = ["position".to_string(), name.clone()];
            let text = csv::text(&header, rows.iter().map(|row| vec![row.0, row.1]))?;
            self.manifest.put(&format!("profile-{name}.csv"), &[text.as_bytes()])?;
        }
        self.manifest.put(SUMMARY, &[finished.summary.json(scene).as_bytes()])?;
        self.manifest.sync()
    }
}

/// Gives a scene that was read from a run's folder what it had when the run began, as the manifest tells it.
pub fn begun_as(scene: &mut Scene, about: &str) {
    #[derive(serde::Deserialize)]
    struct About {
        scene: String,
        variant: Option<String>,
        warnings: Vec<String>,
    }
    if let Ok(About { scene: name, variant, warnings }) = serde_json::from_str(about) {
        (scene.name, scene.variant, scene.warnings) = (name, variant, warnings);
    }
}

fn series_names(observers: &[Observer]) -> Vec<&String> {
    observers.iter().filter(|o| matches!(o.kind.value, Value::Series(_))).map(|o| &o.name).collect()
}

/// What paints the pictures. A run that is told not to use the GPU paints on the CPU too.
fn painter(options: &Options) -> Result<Painter, String> {
    match options.choice {
        Choice::Cpu | Choice::Cpu32 => Ok(Painter::Splat),
        Choice::Auto | Choice::Gpu(_) => Painter::choose(false),
    }
}

/// How a scene is looked at in its first frame.
pub fn view(scene: &Scene) -> View {
    let picture = &scene.file.output.picture;
    let bounds = match &picture.bounds {
        Some([low, high]) => [low.vector().to_array(), high.vector().to_array()],
        None => {
            let (low, high) = scene.extent();
            let margin = (high - low) * 0.05;
            [(low - margin).to_array(), (high + margin).to_array()]
        }
    };
    View {
        width: picture.width,
        height: picture.height,
        field: picture.field.clone(),
        range: picture.range,
        eye: picture.eye,
        bounds: Some(bounds),
        caption: scene.label(),
    }
}
