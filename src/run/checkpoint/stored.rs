//! A checkpoint as a file: HDF5, and behind it a seal by which damage is noticed.

use super::{Checkpoint, Story};
use crate::backend::Saved;
use crate::fields::Field;
use crate::output::manifest::Content;
use crate::output::memory_file::{self, group};
use crate::output::vtkhdf::reason;
use crate::rows::Clock;
use crate::run::summary::StepLengths;
use blake3::Hash;
use hdf5::{Dataset, File, Group, H5Type};
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// The seal: this word and the BLAKE3 of all before it. HDF5 does not look behind the end of what it wrote.
const SEAL: &[u8; 8] = b"lithosph";
const SEAL_BYTES: u64 = SEAL.len() as u64 + 32;

/// Where the file has the fields of a group of particles.
fn place(group: usize) -> String {
    if group == 0 { "fields".into() } else { format!("fields_{group}") }
}

fn data<T: H5Type>(group: &Group, name: &str, values: &[T]) -> hdf5::Result<Dataset> {
    let dataset = group.new_dataset::<T>().obj_track_times(false).shape((values.len(),)).create(name)?;
    if !values.is_empty() {
        dataset.write_raw(values)?;
    }
    Ok(dataset)
}

fn text(group: &Group, name: &str, text: &str) -> hdf5::Result<()> {
    data(group, name, text.as_bytes()).map(|_| ())
}

impl Checkpoint {
    /// Hands on the parts of its file. The columns are given back as they are written, so that it takes no more memory.
    pub fn put<T>(self, put: impl FnOnce(&[&[u8]]) -> Result<T, String>) -> Result<Option<T>, String> {
        let sealed = |bytes: &[u8]| put(&[bytes, SEAL, blake3::hash(bytes).as_bytes()]);
        let made = memory_file::make(|file| self.lay_out(file), sealed);
        made.map_err(|error| format!("HDF5 cannot lay out the checkpoint: {}", reason(&error)))?.map(Some)
    }

    fn lay_out(self, file: &File) -> hdf5::Result<()> {
        data(file, "progress", &[self.event as f64, self.time, f64::from(self.steps)])?;
        data(file, "watch", &self.watch)?;
        text(file, "name", &self.name)?;
        text(file, "scene", &self.scene)?;
        text(file, "device", &self.device)?;
        if let Some(variant) = &self.variant {
            text(file, "variant", variant)?;
        }
        self.story.lay_out(&group(file, "story")?)?;
        for (k, columns) in self.groups.into_iter().enumerate() {
            let group = group(file, &place(k))?;
            for (field, bytes) in columns {
                data(&group, field.name(), &bytes)?;
            }
        }
        Ok(())
    }
}

/// Reads a checkpoint; the error says that it is not as it was written.
pub fn read(path: &Path) -> Result<Checkpoint, String> {
    let damaged = |why: String| format!("{} is damaged: {why}", path.display());
    check_seal(path).map_err(damaged)?;
    read_from(path).map_err(|error| damaged(reason(&error)))
}

fn check_seal(path: &Path) -> Result<(), String> {
    let words = |error: std::io::Error| error.to_string();
    let mut file = std::fs::File::open(path).map_err(words)?;
    let length = file.metadata().map_err(words)?.len().checked_sub(SEAL_BYTES).ok_or("it is cut short")?;
    let (mut hasher, mut seal) = (blake3::Hasher::new(), Vec::new());
    hasher.update_reader(std::io::Read::by_ref(&mut file).take(length)).map_err(words)?;
    file.seek(SeekFrom::Start(length)).and_then(|_| file.read_to_end(&mut seal)).map_err(words)?;
    match seal.strip_prefix(SEAL) {
        None => Err("its seal is missing, so that it is cut short or of another version".into()),
        Some(hash) if hash != hasher.finalize().as_bytes() => Err("its checksum is not that of its bytes".into()),
        Some(_) => Ok(()),
    }
}

fn numbers(group: &Group, name: &str) -> hdf5::Result<Vec<f64>> {
    group.dataset(name)?.read_raw::<f64>()
}

fn words(group: &Group, name: &str) -> hdf5::Result<String> {
    Ok(String::from_utf8_lossy(&group.dataset(name)?.read_raw::<u8>()?).into_owned())
}

fn read_from(path: &Path) -> hdf5::Result<Checkpoint> {
    let mut options = File::with_options();
    options.with_fapl(|access| access.file_locking(false));
    let file = options.open(path)?;
    let [event, time, steps] = numbers(&file, "progress")?[..] else { return Err("it tells no progress".into()) };
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
        event: event as usize,
        time,
        steps: steps as u32,
        watch: numbers(&file, "watch")?,
        name: words(&file, "name")?,
        variant: if file.link_exists("variant") { Some(words(&file, "variant")?) } else { None },
        scene: words(&file, "scene")?,
        device: words(&file, "device")?,
        groups,
        story: Story::read(&file.group("story")?)?,
    })
}

impl Story {
    fn lay_out(&self, group: &Group) -> hdf5::Result<()> {
        let clock = |c: &Clock<f64>| {
            [f64::from(c.steps_done), f64::from(c.lists_built), f64::from(c.changes), c.held, f64::from(c.arrived)]
        };
        data(group, "clocks", &self.clocks.iter().flat_map(clock).collect::<Vec<_>>())?;
        let StepLengths { shortest, longest, changes } = self.lengths;
        data(group, "counts", &[f64::from(self.lists), shortest, longest, f64::from(changes), self.spent[0], self.spent[1]])?;
        data(group, "balance", &self.balance)?;
        data(group, "neighbors", self.neighbors.as_slice())?;
        text(group, "warnings", &serde_json::json!(self.warnings).to_string())?;
        text(group, "told", &serde_json::json!(self.told).to_string())?;
        data(group, "frame_numbers", &self.frames.iter().map(|frame| frame.0).collect::<Vec<_>>())?;
        data(group, "frame_times", &self.frames.iter().map(|frame| frame.1).collect::<Vec<_>>())?;
        data(group, "frame_steps", &self.frames.iter().map(|frame| frame.2).collect::<Vec<_>>())?;
        if let Some(series) = self.series {
            data(group, "series_bytes", &[series.bytes])?;
            data(group, "series_hash", series.hash.as_bytes())?;
        }
        Ok(())
    }

    fn read(group: &Group) -> hdf5::Result<Self> {
        let list = |error: serde_json::Error| hdf5::Error::from(error.to_string());
        let [lists, shortest, longest, changes, wall, processor] = numbers(group, "counts")?[..] else {
            return Err("it tells no counts".into());
        };
        let clocks = numbers(group, "clocks")?;
        let clock = |&[steps, lists, changes, held, arrived]: &[f64; 5]| Clock {
            steps_done: steps as u32,
            lists_built: lists as u32,
            changes: changes as u32,
            held,
            arrived: arrived as u32,
            ..Clock::default()
        };
        let series = if group.link_exists("series_bytes") {
            let (bytes, hash) = (group.dataset("series_bytes")?.read_raw()?, group.dataset("series_hash")?.read_raw::<u8>()?);
            let hash = Hash::from_slice(&hash).map_err(|error| hdf5::Error::from(error.to_string()))?;
            Some(Content { hash, bytes: bytes.first().copied().unwrap_or_default() })
        } else {
            None
        };
        let (times, steps) = (numbers(group, "frame_times")?, group.dataset("frame_steps")?.read_raw::<u64>()?);
        let frames = group.dataset("frame_numbers")?.read_raw::<u32>()?.into_iter().zip(times).zip(steps);
        Ok(Self {
            clocks: clocks.as_chunks::<5>().0.iter().map(clock).collect(),
            lists: lists as u32,
            lengths: StepLengths { shortest, longest, changes: changes as u32 },
            warnings: serde_json::from_str(&words(group, "warnings")?).map_err(list)?,
            told: serde_json::from_str(&words(group, "told")?).map_err(list)?,
            balance: numbers(group, "balance")?,
            neighbors: numbers(group, "neighbors")?.first().copied(),
            spent: [wall, processor],
            series,
            frames: frames.map(|((number, time), step)| (number, time, step)).collect(),
        })
    }
}
