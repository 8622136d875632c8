//! Particles over time for ParaView: one `.vtkhdf` file that grows by a step at each output.
//!
//! The layout is VTKHDF 2.1, temporal `PolyData`, with a single poly-vertex cell that holds every
//! particle; see <https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/>. What VTK does
//! not name (step number, spacing, dimension) lies beside it in the group `/lithosph`.
//!
//! The file is open only while a step is written, and `NSteps` is raised last: a kill between
//! outputs loses nothing, and what a kill during one leaves behind is overwritten by the next.

mod layout;

use super::{Column, Snapshot};
use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, File, H5Type};
use layout::{is_number, lay_out};
use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;

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

fn options() -> hdf5::FileBuilder {
    let mut options = File::with_options();
    // Without locks a ParaView that has the file open cannot stop the run at its next output.
    options.with_fapl(|access| access.libver_v18().file_locking(false));
    options
}

fn open(path: &Path, write: bool) -> hdf5::Result<File> {
    if write { options().open_rw(path) } else { options().open(path) }
}

/// Starts a new file and writes `snapshot` as its first step.
pub fn create(path: &Path, snapshot: &Snapshot) -> Result<(), String> {
    check(snapshot)?;
    at(path, lay_out(path, snapshot))?;
    append(path, snapshot)
}

/// Adds a step with the same particles and the same columns as the steps before it.
pub fn append(path: &Path, snapshot: &Snapshot) -> Result<(), String> {
    check(snapshot)?;
    reserve(path, snapshot).map_err(|error| format!("{}: {error}", path.display()))?;
    let file = at(path, open(path, true))?;
    at(path, same_content(&file, snapshot))?.map_err(|why| format!("{}: {why}", path.display()))?;
    at(path, append_step(&file, snapshot).and_then(|()| file.close()))
}

/// More than the chunks of per-step numbers and the indices take that one step may begin.
const RESERVE: usize = 512 << 10;

/// Takes the room of a step at the end of the file, and gives it back where the disk has not enough: HDF5
/// would break off in the middle and leave a file that nothing can open. HDF5 itself cuts off what is left.
fn reserve(path: &Path, snapshot: &Snapshot) -> std::io::Result<()> {
    let numbers: usize = 3 + snapshot.columns.iter().map(|column| column.components).sum::<usize>();
    let bytes = size_of::<f32>() * numbers * snapshot.positions.len();
    let mut file = OpenOptions::new().append(true).open(path)?;
    let length = file.metadata()?.len();
    let block = vec![0u8; RESERVE];
    for _ in 0..1 + bytes.div_ceil(RESERVE) {
        if let Err(error) = file.write_all(&block) {
            file.set_len(length)?;
            return Err(error);
        }
    }
    Ok(())
}

/// Drops the steps later than `time`, so that a resumed run continues from its checkpoint.
pub fn truncate_after(path: &Path, time: f64) -> Result<(), String> {
    let kept = read(path)?.iter().take_while(|&&t| t <= time).count();
    at(
        path,
        open(path, true).and_then(|file| {
            let steps = file.group("VTKHDF/Steps")?;
            // First, so that a kill below leaves rows that nothing refers to.
            steps.attr("NSteps")?.write_scalar(&(kept as i64))?;
            let count = particles(&file)?;
            for dataset in file.group("VTKHDF/PointData")?.datasets()? {
                resize_rows(&dataset, kept * count)?;
            }
            resize_rows(&file.dataset("VTKHDF/Points")?, kept * count)?;
            for dataset in per_step(&file)? {
                resize_rows(&dataset, kept)?;
            }
            file.close()
        }),
    )
}

/// The times of all steps.
pub fn read(path: &Path) -> Result<Vec<f64>, String> {
    at(
        path,
        open(path, false).and_then(|file| {
            let mut times = file.dataset("VTKHDF/Steps/Values")?.read_raw::<f64>()?;
            times.truncate(step_count(&file)?);
            Ok(times)
        }),
    )
}

/// Step `k` as it was written, to the precision of f32.
pub fn read_step(path: &Path, k: usize) -> Result<Snapshot, String> {
    let steps = read(path)?.len();
    if k >= steps {
        return Err(format!("{} has {steps} steps, not a step {k}", path.display()));
    }
    at(path, open(path, false).and_then(|file| snapshot_of(&file, k)))
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

fn same_content(file: &File, snapshot: &Snapshot) -> hdf5::Result<Result<(), String>> {
    let (stored, given) = (particles(file)?, snapshot.positions.len());
    if stored != given {
        return Ok(Err(format!("it holds {stored} particles, not {given}")));
    }
    let mut names: Vec<_> = snapshot.columns.iter().map(|column| column.name.clone()).collect();
    let mut columns = file.group("VTKHDF/PointData")?.member_names()?;
    names.sort();
    columns.sort();
    Ok(if names == columns { Ok(()) } else { Err(format!("it holds the columns {columns:?}, not {names:?}")) })
}

fn append_step(file: &File, snapshot: &Snapshot) -> hdf5::Result<()> {
    let root = file.group("VTKHDF")?;
    let steps = root.group("Steps")?;
    let (k, count) = (step_count(file)?, snapshot.positions.len());
    let points: Vec<f64> = snapshot.positions.iter().flatten().copied().collect();
    put(&root.dataset("Points")?, k * count, 3, &each(&points, |v| v as f32))?;
    let point_data = root.group("PointData")?;
    for column in &snapshot.columns {
        let Column { name, components, values, .. } = column;
        let dataset = point_data.dataset(name)?;
        match is_number(name) {
            true => put(&dataset, k * count, *components, &each(values, |v| v.round() as i32))?,
            false => put(&dataset, k * count, *components, &each(values, |v| v as f32))?,
        }
        put(&steps.dataset(&format!("PointDataOffsets/{name}"))?, k, 1, &[(k * count) as i64])?;
    }
    put(&root.dataset("NumberOfPoints")?, k, 1, &[count as i64])?;
    for kind in ["Vertices", "Lines", "Polygons", "Strips"] {
        let used = i64::from(kind == "Vertices");
        put(&root.dataset(&format!("{kind}/NumberOfCells"))?, k, 1, &[used])?;
        put(&root.dataset(&format!("{kind}/NumberOfConnectivityIds"))?, k, 1, &[used * count as i64])?;
    }
    put(&steps.dataset("PartOffsets")?, k, 1, &[k as i64])?;
    put(&steps.dataset("NumberOfParts")?, k, 1, &[1i64])?;
    put(&steps.dataset("PointOffsets")?, k, 1, &[(k * count) as i64])?;
    put(&steps.dataset("CellOffsets")?, k, 4, &[0i64; 4])?;
    put(&steps.dataset("ConnectivityIdOffsets")?, k, 4, &[0i64; 4])?;
    put(&steps.dataset("Values")?, k, 1, &[snapshot.time])?;
    put(&file.dataset("lithosph/step")?, k, 1, &[snapshot.step as i64])?;
    // What precedes must be on the disk before a reader may look for it.
    file.flush()?;
    steps.attr("NSteps")?.write_scalar(&(k as i64 + 1))
}

fn each<T>(values: &[f64], converted: impl Fn(f64) -> T) -> Vec<T> {
    values.iter().map(|&value| converted(value)).collect()
}

/// Writes whole rows from `row` on and ends the dataset there.
fn put<T: H5Type>(dataset: &Dataset, row: usize, components: usize, values: &[T]) -> hdf5::Result<()> {
    let end = row + values.len() / components;
    resize_rows(dataset, end)?;
    match components {
        1 => dataset.write_slice(values, row..end),
        3 => dataset.write_slice::<_, T, _, _>(values.as_chunks::<3>().0, (row..end, ..)),
        4 => dataset.write_slice::<_, T, _, _>(values.as_chunks::<4>().0, (row..end, ..)),
        6 => dataset.write_slice::<_, T, _, _>(values.as_chunks::<6>().0, (row..end, ..)),
        _ => Err(format!("{} components", components).into()),
    }
}

fn resize_rows(dataset: &Dataset, rows: usize) -> hdf5::Result<()> {
    match dataset.shape()[..] {
        [_, components] => dataset.resize((rows, components)),
        _ => dataset.resize((rows,)),
    }
}

fn step_count(file: &File) -> hdf5::Result<usize> {
    file.group("VTKHDF/Steps")?.attr("NSteps")?.read_scalar::<i64>().map(|n| n as usize)
}

fn particles(file: &File) -> hdf5::Result<usize> {
    Ok(file.dataset("VTKHDF/Vertices/Connectivity")?.size())
}

/// Every dataset with one row a step.
fn per_step(file: &File) -> hdf5::Result<Vec<Dataset>> {
    let mut datasets = file.group("VTKHDF/Steps")?.datasets()?;
    datasets.extend(file.group("VTKHDF/Steps/PointDataOffsets")?.datasets()?);
    datasets.extend([file.dataset("VTKHDF/NumberOfPoints")?, file.dataset("lithosph/step")?]);
    for kind in ["Vertices", "Lines", "Polygons", "Strips"] {
        datasets.push(file.dataset(&format!("VTKHDF/{kind}/NumberOfCells"))?);
        datasets.push(file.dataset(&format!("VTKHDF/{kind}/NumberOfConnectivityIds"))?);
    }
    Ok(datasets)
}

fn snapshot_of(file: &File, k: usize) -> hdf5::Result<Snapshot> {
    let own = file.group("lithosph")?;
    let count = particles(file)?;
    let (_, points) = get(&file.dataset("VTKHDF/Points")?, k, count)?;
    let mut columns = Vec::new();
    for dataset in file.group("VTKHDF/PointData")?.datasets()? {
        let (components, values) = get(&dataset, k, count)?;
        let name = dataset.name().rsplit('/').next().unwrap_or_default().to_string();
        let unit = dataset.attr("unit")?.read_scalar::<VarLenUnicode>()?.to_string();
        columns.push(Column { name, unit, components, values });
    }
    Ok(Snapshot {
        time: file.dataset("VTKHDF/Steps/Values")?.read_raw::<f64>()?[k],
        step: file.dataset("lithosph/step")?.read_raw::<i64>()?[k] as u64,
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
