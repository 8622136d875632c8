//! The groups and datasets of a new file, all of them empty.

use super::super::Snapshot;
use hdf5::types::{FixedAscii, VarLenUnicode};
use hdf5::{Dataset, Group, H5Type, Location};
use std::path::Path;

/// Rows of a chunk at most: small enough to read one particle range, large enough to compress.
const CHUNK_ROWS: usize = 65_536;
/// Rows of a chunk of per-step numbers.
const CHUNK_STEPS: usize = 256;

pub fn lay_out(path: &Path, snapshot: &Snapshot) -> hdf5::Result<()> {
    let file = super::options().create(path)?;
    let count = snapshot.positions.len();
    let root = file.create_group("VTKHDF")?;
    root.new_attr_builder().with_data(&[2i64, 1]).create("Version")?;
    attribute(&root, "Type", &FixedAscii::<8>::from_ascii("PolyData").map_err(|e| e.to_string())?)?;
    lay_out_cells(&root, count)?;

    rows::<f32>(&root, "Points", count, 3)?;
    let point_data = root.create_group("PointData")?;
    for column in &snapshot.columns {
        let dataset = if is_number(&column.name) {
            rows::<i32>(&point_data, &column.name, count, column.components)?
        } else {
            rows::<f32>(&point_data, &column.name, count, column.components)?
        };
        attribute(&dataset, "unit", &unicode(&column.unit)?)?;
    }
    lay_out_steps(&root, snapshot)?;

    let own = file.create_group("lithosph")?;
    attribute(&own, "dimension", &(snapshot.dimension as i64))?;
    attribute(&own, "spacing", &snapshot.spacing)?;
    series::<i64>(&own, "step", 1)?;
    file.close()
}

/// One poly-vertex cell, stored once for all steps; the other kinds of cell are empty.
fn lay_out_cells(root: &Group, count: usize) -> hdf5::Result<()> {
    for kind in ["Vertices", "Lines", "Polygons", "Strips"] {
        let group = root.create_group(kind)?;
        let used = if kind == "Vertices" { count as i64 } else { 0 };
        let connectivity: Vec<i64> = (0..used).collect();
        let offsets = if used > 0 { vec![0, used] } else { vec![0] };
        group.new_dataset_builder().with_data(&connectivity[..]).create("Connectivity")?;
        group.new_dataset_builder().with_data(&offsets[..]).create("Offsets")?;
        series::<i64>(&group, "NumberOfCells", 1)?;
        series::<i64>(&group, "NumberOfConnectivityIds", 1)?;
    }
    series::<i64>(root, "NumberOfPoints", 1).map(|_| ())
}

fn lay_out_steps(root: &Group, snapshot: &Snapshot) -> hdf5::Result<()> {
    let steps = root.create_group("Steps")?;
    attribute(&steps, "NSteps", &0i64)?;
    series::<f64>(&steps, "Values", 1)?;
    for name in ["PartOffsets", "NumberOfParts", "PointOffsets"] {
        series::<i64>(&steps, name, 1)?;
    }
    // One number for each of vertices, lines, polygons and strips.
    series::<i64>(&steps, "CellOffsets", 4)?;
    series::<i64>(&steps, "ConnectivityIdOffsets", 4)?;
    let offsets = steps.create_group("PointDataOffsets")?;
    snapshot.columns.iter().try_for_each(|column| series::<i64>(&offsets, &column.name, 1).map(|_| ()))
}

/// A compressed dataset of particles, empty yet, that grows by whole steps.
fn rows<T: H5Type>(group: &Group, name: &str, count: usize, components: usize) -> hdf5::Result<Dataset> {
    // Equal chunks that fill a step to within a row keep one step from rewriting the last one.
    let chunk = count.div_ceil(count.div_ceil(CHUNK_ROWS)).max(256);
    let builder = group.new_dataset::<T>().shuffle().deflate(1);
    match components {
        1 => builder.chunk((chunk,)).shape((0..,)).create(name),
        _ => builder.chunk((chunk, components)).shape((0.., components)).create(name),
    }
}

/// A dataset with one row a step, empty yet.
fn series<T: H5Type>(group: &Group, name: &str, components: usize) -> hdf5::Result<Dataset> {
    let builder = group.new_dataset::<T>();
    match components {
        1 => builder.chunk((CHUNK_STEPS,)).shape((0..,)).create(name),
        _ => builder.chunk((CHUNK_STEPS, components)).shape((0.., components)).create(name),
    }
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
