//! Particles over time for ParaView: a file for each frame, never written again, and a small master that readers open as one.
//!
//! The layout is VTKHDF 2.1, temporal `PolyData`, with a single poly-vertex cell that holds every
//! particle; see <https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/>. What VTK does
//! not name (step number, spacing, dimension, number of the frame) lies beside it in the group `/lithosph`.
//!
//! `particles/00012.vtkhdf` holds the particles of one moment, and can be opened alone. `particles.vtkhdf` beside the folder has
//! the times of all frames and virtual datasets, which HDF5 fills from the frames. Both are made in memory and put into their
//! places whole: see [`super::durable`].

mod layout;

pub use layout::Shape;

use super::memory_file;
use super::{Column, Snapshot};
use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, File, H5Type};
use std::path::{Path, PathBuf};

/// A frame that the master refers to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kept {
    /// Number of its file and of its picture.
    pub number: u32,
    pub time: f64,
    pub step: u64,
}

/// Where a frame's file lies, from the folder of the master.
pub fn frame_name(number: u32) -> String {
    format!("particles/{number:05}.vtkhdf")
}

/// Names the file in an error.
fn at<T>(path: &Path, result: hdf5::Result<T>) -> Result<T, String> {
    result.map_err(|error| format!("{}: {}", path.display(), reason(&error)))
}

/// The operating system's reason, which HDF5 buries in several lines of its own.
pub fn reason(error: &hdf5::Error) -> String {
    let text = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    let buried = text.split_once("error message = '").and_then(|(_, rest)| rest.split_once('\''));
    buried.map_or_else(|| text.clone(), |(reason, _)| reason.to_string())
}

fn open(path: &Path) -> hdf5::Result<File> {
    let mut options = File::with_options();
    // Without locks a reader cannot stop a run, nor a run a reader.
    options.with_fapl(|access| access.file_locking(false));
    options.open(path)
}

/// Bytes of the file of one frame.
pub fn frame(snapshot: &Snapshot) -> Result<Vec<u8>, String> {
    check(snapshot)?;
    made(memory_file::make(|file| layout::frame(file, snapshot), <[u8]>::to_vec))
}

/// Bytes of the master of some frames.
pub fn master(shape: &Shape, kept: &[Kept]) -> Result<Vec<u8>, String> {
    made(memory_file::make(|file| layout::master(file, shape, kept), <[u8]>::to_vec))
}

fn made(bytes: hdf5::Result<Vec<u8>>) -> Result<Vec<u8>, String> {
    bytes.map_err(|error| format!("HDF5 cannot lay out the particles: {}", reason(&error)))
}

/// The frames that a master refers to.
pub fn kept(path: &Path) -> Result<Vec<Kept>, String> {
    at(
        path,
        open(path).and_then(|file| {
            let (times, steps) = (times(&file)?, file.dataset("lithosph/step")?.read_raw::<i64>()?);
            let numbers = file.dataset("lithosph/frame")?.read_raw::<i64>()?;
            let frame = |((time, step), number)| Kept { number: number as u32, time, step: step as u64 };
            Ok(times.into_iter().zip(steps).zip(numbers).map(frame).collect())
        }),
    )
}

/// What the frames have in common that a frame's file is one of.
pub fn shape(path: &Path) -> Result<Shape, String> {
    read_step(path, 0).map(|snapshot| Shape::of(&snapshot))
}

/// The times of all steps of a master, or of a file that holds its particles itself.
pub fn read(path: &Path) -> Result<Vec<f64>, String> {
    at(path, open(path).and_then(|file| times(&file)))
}

fn times(file: &File) -> hdf5::Result<Vec<f64>> {
    let mut times = file.dataset("VTKHDF/Steps/Values")?.read_raw::<f64>()?;
    times.truncate(file.group("VTKHDF/Steps")?.attr("NSteps")?.read_scalar::<i64>()? as usize);
    Ok(times)
}

/// Everything of step `k`. A master's step is read from the frame's own file: HDF5 fills in zeros for a file that is missing.
pub fn read_step(path: &Path, k: usize) -> Result<Snapshot, String> {
    let steps = read(path)?.len();
    if k >= steps {
        return Err(format!("{} has {steps} steps, not a step {k}", path.display()));
    }
    let number = at(path, open(path).and_then(|file| number(&file, k)))?;
    let (path, k) = number.map_or_else(|| (path.to_path_buf(), k), |number| (beside(path, number), 0));
    at(&path, open(&path).and_then(|file| snapshot_of(&file, k)))
}

/// The number of a master's frame `k`; none where the file is no master.
fn number(file: &File, k: usize) -> hdf5::Result<Option<u32>> {
    if !file.link_exists("lithosph/frame") {
        return Ok(None);
    }
    let numbers = file.dataset("lithosph/frame")?.read_raw::<i64>()?;
    numbers.get(k).map_or_else(|| Err(format!("it has no frame {k}").into()), |&number| Ok(Some(number as u32)))
}

fn beside(master: &Path, number: u32) -> PathBuf {
    master.with_file_name(frame_name(number))
}

fn check(snapshot: &Snapshot) -> Result<(), String> {
    let count = snapshot.positions.len();
    for Column { name, components, values, .. } in &snapshot.columns {
        if ![1, 3, 6].contains(components) || values.len() != count * components {
            return Err(format!("column {name} does not fit {count} particles"));
        }
    }
    if count == 0 { Err("there is no particle to write".into()) } else { Ok(()) }
}

/// Writes all rows of a dataset.
fn put<T: H5Type>(dataset: &Dataset, components: usize, values: &[T]) -> hdf5::Result<()> {
    match components {
        1 => dataset.write_raw(values),
        3 => dataset.write_slice::<_, T, _, _>(values.as_chunks::<3>().0, (.., ..)),
        4 => dataset.write_slice::<_, T, _, _>(values.as_chunks::<4>().0, (.., ..)),
        6 => dataset.write_slice::<_, T, _, _>(values.as_chunks::<6>().0, (.., ..)),
        _ => Err(format!("{components} components").into()),
    }
}

fn snapshot_of(file: &File, k: usize) -> hdf5::Result<Snapshot> {
    let own = file.group("lithosph")?;
    let count = file.dataset("VTKHDF/Vertices/Connectivity")?.size();
    let (_, points) = get(&file.dataset("VTKHDF/Points")?, k, count)?;
    let mut columns = Vec::new();
    for dataset in file.group("VTKHDF/PointData")?.datasets()? {
        let (components, values) = get(&dataset, k, count)?;
        let name = dataset.name().rsplit('/').next().unwrap_or_default().to_string();
        let unit = dataset.attr("unit")?.read_scalar::<VarLenUnicode>()?.to_string();
        columns.push(Column { name, unit, components, values });
    }
    let step = file.dataset("lithosph/step")?.read_raw::<i64>()?;
    let (time, step) = times(file)?.get(k).copied().zip(step.get(k).copied()).ok_or("it has too few steps")?;
    Ok(Snapshot {
        time,
        step: step as u64,
        dimension: own.attr("dimension")?.read_scalar::<i64>()? as usize,
        spacing: own.attr("spacing")?.read_scalar()?,
        positions: points.as_chunks::<3>().0.to_vec(),
        columns,
    })
}

/// Components and row-major values of step `k`; HDF5 converts whatever is stored to f64.
fn get(dataset: &Dataset, k: usize, count: usize) -> hdf5::Result<(usize, Vec<f64>)> {
    let range = k * count..(k + 1) * count;
    match dataset.shape()[..] {
        [_, components] => {
            let values = dataset.read_slice_2d::<f64, _>((range, ..))?;
            Ok((components, values.into_raw_vec_and_offset().0))
        }
        _ => Ok((1, dataset.read_slice_1d::<f64, _>(range)?.into_raw_vec_and_offset().0)),
    }
}

#[cfg(test)]
mod tests;
