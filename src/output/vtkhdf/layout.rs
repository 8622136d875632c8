//! The groups and datasets of a frame, which holds its particles, and of the master, which refers to those of all frames.

use super::super::memory_file::group;
use super::super::{Column, Snapshot};
use super::{Kept, frame_name, put};
use hdf5::types::{FixedAscii, VarLenUnicode};
use hdf5::{Dataset, File, Group, H5Type, Location};

/// Rows of a chunk at most: small enough to read one particle range, large enough to compress.
const CHUNK_ROWS: usize = 65_536;

/// What all frames of a run have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    pub particles: usize,
    pub dimension: usize,
    pub spacing: f64,
    /// Name, unit and components of each column.
    pub columns: Vec<(String, String, usize)>,
}

impl Shape {
    pub fn of(snapshot: &Snapshot) -> Self {
        let column = |column: &Column| (column.name.clone(), column.unit.clone(), column.components);
        Self {
            particles: snapshot.positions.len(),
            dimension: snapshot.dimension,
            spacing: snapshot.spacing,
            columns: snapshot.columns.iter().map(column).collect(),
        }
    }
}

/// The particles of one moment: a temporal file of one step.
pub fn frame(file: &File, snapshot: &Snapshot) -> hdf5::Result<()> {
    let (shape, count) = (Shape::of(snapshot), snapshot.positions.len());
    let root = head(file, &shape)?;
    let identity: Vec<i64> = (0..count as i64).collect();
    put(&rows::<i64>(&group(&root, "Vertices")?, "Connectivity", count, 1)?, 1, &identity)?;
    let points: Vec<f64> = snapshot.positions.iter().flatten().copied().collect();
    put(&rows::<f32>(&root, "Points", count, 3)?, 3, &each(&points, |v| v as f32))?;
    let point_data = group(&root, "PointData")?;
    for Column { name, unit, components, values } in &snapshot.columns {
        let dataset = if is_number(name) {
            let dataset = rows::<i32>(&point_data, name, count, *components)?;
            put(&dataset, *components, &each(values, |v| v.round() as i32)).map(|()| dataset)
        } else {
            let dataset = rows::<f32>(&point_data, name, count, *components)?;
            put(&dataset, *components, &each(values, |v| v as f32)).map(|()| dataset)
        }?;
        attribute(&dataset, "unit", &unicode(unit)?)?;
    }
    steps(file, &root, &shape, &[Kept { number: 0, time: snapshot.time, step: snapshot.step }])
}

/// All frames as one temporal file, whose particles lie in the frames' own files.
pub fn master(file: &File, shape: &Shape, kept: &[Kept]) -> hdf5::Result<()> {
    let root = head(file, shape)?;
    let first = &kept[..1.min(kept.len())];
    // One poly-vertex cell serves all steps.
    referred::<i64>(&group(&root, "Vertices")?, "Vertices/Connectivity", shape.particles, 1, first)?;
    referred::<f32>(&root, "Points", shape.particles, 3, kept)?;
    let point_data = group(&root, "PointData")?;
    for (name, unit, components) in &shape.columns {
        let place = format!("PointData/{name}");
        let dataset = if is_number(name) {
            referred::<i32>(&point_data, &place, shape.particles, *components, kept)?
        } else {
            referred::<f32>(&point_data, &place, shape.particles, *components, kept)?
        };
        attribute(&dataset, "unit", &unicode(unit)?)?;
    }
    steps(file, &root, shape, kept)?;
    let numbers: Vec<i64> = kept.iter().map(|kept| i64::from(kept.number)).collect();
    series(&file.group("lithosph")?, "frame", &numbers).map(|_| ())
}

fn head(file: &File, shape: &Shape) -> hdf5::Result<Group> {
    let root = group(file, "VTKHDF")?;
    root.new_attr_builder().with_data(&[2i64, 1]).create("Version")?;
    attribute(&root, "Type", &FixedAscii::<8>::from_ascii("PolyData").map_err(|e| e.to_string())?)?;
    let own = group(file, "lithosph")?;
    attribute(&own, "dimension", &(shape.dimension as i64))?;
    attribute(&own, "spacing", &shape.spacing)?;
    Ok(root)
}

/// Everything with one row a step, and cells: one poly-vertex, stored once for all steps; the other kinds of cell are empty.
fn steps(file: &File, root: &Group, shape: &Shape, kept: &[Kept]) -> hdf5::Result<()> {
    let (count, particles) = (kept.len(), shape.particles as i64);
    let all = |value: i64| vec![value; count];
    let numbered = |times: i64| (0..count as i64).map(|k| k * times).collect::<Vec<_>>();
    for kind in ["Vertices", "Lines", "Polygons", "Strips"] {
        let used = i64::from(kind == "Vertices");
        let cells = if used > 0 { root.group(kind)? } else { group(root, kind)? };
        if used == 0 {
            series::<i64>(&cells, "Connectivity", &[])?;
        }
        series(&cells, "Offsets", &[0, particles][..1 + used as usize])?;
        series(&cells, "NumberOfCells", &all(used))?;
        series(&cells, "NumberOfConnectivityIds", &all(used * particles))?;
    }
    series(root, "NumberOfPoints", &all(particles))?;
    let steps = group(root, "Steps")?;
    attribute(&steps, "NSteps", &(count as i64))?;
    series(&steps, "Values", &kept.iter().map(|kept| kept.time).collect::<Vec<_>>())?;
    series(&steps, "PartOffsets", &numbered(1))?;
    series(&steps, "NumberOfParts", &all(1))?;
    series(&steps, "PointOffsets", &numbered(particles))?;
    // One number for each of vertices, lines, polygons and strips.
    for name in ["CellOffsets", "ConnectivityIdOffsets"] {
        let dataset = steps.new_dataset::<i64>().obj_track_times(false).shape((count, 4)).create(name)?;
        put(&dataset, 4, &vec![0i64; 4 * count])?;
    }
    let offsets = group(&steps, "PointDataOffsets")?;
    for (name, ..) in &shape.columns {
        series(&offsets, name, &numbered(particles))?;
    }
    series(&file.group("lithosph")?, "step", &kept.iter().map(|kept| kept.step as i64).collect::<Vec<_>>())?;
    Ok(())
}

/// A compressed dataset of particles, whose checksums let every reader notice a bit that was flipped.
fn rows<T: H5Type>(group: &Group, name: &str, count: usize, components: usize) -> hdf5::Result<Dataset> {
    let chunk = count.div_ceil(count.div_ceil(CHUNK_ROWS));
    let builder = group.new_dataset::<T>().obj_track_times(false).shuffle().deflate(1).fletcher32();
    match components {
        1 => builder.chunk((chunk,)).shape((count,)).create(name),
        _ => builder.chunk((chunk, components)).shape((count, components)).create(name),
    }
}

/// A dataset that holds the rows of all frames one after the other, each in its own file. `place` is where it lies in
/// `VTKHDF`, of which `group` is the last group.
fn referred<T: H5Type>(group: &Group, place: &str, count: usize, components: usize, kept: &[Kept]) -> hdf5::Result<Dataset> {
    let (total, source) = (kept.len() * count, format!("VTKHDF/{place}"));
    let mut builder = group.new_dataset::<T>().obj_track_times(false);
    for (k, frame) in kept.iter().enumerate() {
        let (name, rows) = (frame_name(frame.number), k * count..(k + 1) * count);
        builder = match components {
            1 => builder.virtual_map(name, &source, (count,), 0..count, (total,), rows),
            _ => builder.virtual_map(name, &source, (count, components), (0..count, ..), (total, components), (rows, ..)),
        };
    }
    let name = place.rsplit('/').next().unwrap_or(place);
    match components {
        1 => builder.shape((total,)).create(name),
        _ => builder.shape((total, components)).create(name),
    }
}

/// A dataset of a few numbers.
fn series<T: H5Type>(group: &Group, name: &str, values: &[T]) -> hdf5::Result<Dataset> {
    let dataset = group.new_dataset::<T>().obj_track_times(false).shape((values.len(),)).create(name)?;
    if !values.is_empty() {
        dataset.write_raw(values)?;
    }
    Ok(dataset)
}

fn each<T>(values: &[f64], converted: impl Fn(f64) -> T) -> Vec<T> {
    values.iter().map(|&value| converted(value)).collect()
}

fn attribute<T: H5Type>(location: &Location, name: &str, value: &T) -> hdf5::Result<()> {
    location.new_attr::<T>().create(name)?.write_scalar(value)
}

fn unicode(text: &str) -> hdf5::Result<VarLenUnicode> {
    text.parse().map_err(|error| format!("{text:?}: {error}").into())
}

/// f32 would lose numbers above 2^24, and ParaView colours integers as categories.
pub fn is_number(name: &str) -> bool {
    matches!(name, "body" | "particle" | "number" | "material")
}
