//! The output folder of a run: `run.toml`, `series.csv`, `particles.vtkhdf`, `frames/*.png`,
//! `summary.json`, `checkpoint.h5`.

use super::checkpoint::Checkpoint;
use super::{Finished, Options};
use crate::backend::Choice;
use crate::fields::Field;
use crate::observable::{Moment, Observer, Table, Value};
use crate::output::csv::{self, Series};
use crate::output::{self, Painter, View};
use crate::scene::Scene;
use std::fs;
use std::path::{Path, PathBuf};

/// An open output folder.
pub struct Files {
    pub folder: PathBuf,
    series: Option<Series>,
    frames: usize,
    painter: Painter,
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
    if folder.exists() && !options.force {
        return Err(format!("{} exists already; --force overwrites it, --out names another folder", folder.display()));
    }
    Ok(())
}

/// Whether a run writes a file of this name.
fn is_own(name: &str) -> bool {
    let name = name.strip_suffix(".part").unwrap_or(name);
    let own = ["run.toml", "series.csv", "particles.vtkhdf", "summary.json", "checkpoint.h5"];
    own.contains(&name) || (name.starts_with("profile-") && name.ends_with(".csv"))
}

impl Files {
    /// Makes the folder, or takes away what a run before wrote to it, and nothing else.
    pub fn create(scene: &Scene, options: &Options) -> Result<Self, String> {
        let folder = options.out.clone().unwrap_or_else(|| folder(scene));
        let text = |e: std::io::Error| format!("cannot write {}: {e}", folder.display());
        let painter = painter(options)?;
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            if is_own(&entry.file_name().to_string_lossy()) {
                let _ = fs::remove_file(entry.path());
            }
        }
        let _ = fs::remove_dir_all(folder.join("frames"));
        fs::create_dir_all(folder.join("frames")).map_err(text)?;
        fs::write(folder.join("run.toml"), &scene.text).map_err(text)?;
        Ok(Self { folder, series: None, frames: 0, painter })
    }

    /// Opens a run's folder again and drops what lies after a time; gives the series up to there.
    pub fn reopen(scene: &Scene, options: &Options, folder: PathBuf, time: f64) -> Result<(Self, Table), String> {
        let path = folder.join("series.csv");
        csv::truncate_after(&path, time)?;
        let (names, rows) = csv::read(&path)?;
        let mut table = Table { times: rows.iter().map(|r| r[0]).collect(), ..Table::default() };
        for (k, name) in names.iter().enumerate().skip(1) {
            table.columns.insert(name.clone(), rows.iter().map(|r| r[k]).collect());
        }
        let interval = scene.file.frames();
        let frames = if interval > 0.0 { (time / interval + 1e-9) as usize + 1 } else { 0 };
        // A run without frames has no file of particles.
        #[cfg(feature = "hdf5")]
        if frames > 0 {
            output::vtkhdf::truncate_after(&folder.join("particles.vtkhdf"), time)?;
        }
        Ok((Self { series: Some(Series::open_append(&path)?), folder, frames, painter: painter(options)? }, table))
    }

    /// Writes the last row of the table.
    pub fn row(&mut self, time: f64, observers: &[Observer], table: &Table) -> Result<(), String> {
        let names: Vec<&String> = series_names(observers);
        let series = match &mut self.series {
            Some(series) => series,
            none => {
                let header: Vec<String> = std::iter::once("time".to_string()).chain(names.iter().map(|n| (*n).clone())).collect();
                none.insert(Series::create(&self.folder.join("series.csv"), &header)?)
            }
        };
        let last = |name: &&String| table.columns[*name].last().copied().unwrap_or(f64::NAN);
        series.row(&std::iter::once(time).chain(names.iter().map(last)).collect::<Vec<_>>())
    }

    /// Stores and paints a moment; gives the picture's place in the folder.
    pub fn frame(&mut self, scene: &Scene, moment: &Moment) -> Result<String, String> {
        let snapshot = moment.snapshot(&quantities(scene));
        #[cfg(feature = "hdf5")]
        {
            let path = self.folder.join("particles.vtkhdf");
            if self.frames == 0 { output::vtkhdf::create(&path, &snapshot)? } else { output::vtkhdf::append(&path, &snapshot)? }
        }
        let mut view = view(scene);
        if scene.file.output.picture.bounds.is_none() {
            view.bounds = view.bounds.map(|first| output::follow(first, &snapshot));
        }
        let picture = self.painter.paint(&snapshot, &view)?;
        let place = format!("frames/{:05}.png", self.frames);
        output::save_png(&self.folder.join(&place), &picture)?;
        self.frames += 1;
        Ok(place)
    }

    pub fn checkpoint(&self, saved: &Checkpoint) -> Result<(), String> {
        saved.write(&self.folder)
    }

    /// Summary and profiles.
    pub fn finish(&self, scene: &Scene, finished: &Finished) -> Result<(), String> {
        for (name, rows) in &finished.profiles {
            let header = ["position".to_string(), name.clone()];
            let mut file = Series::create(&self.folder.join(format!("profile-{name}.csv")), &header)?;
            for row in rows {
                file.row(&[row.0, row.1])?;
            }
        }
        let text = finished.summary.json(scene);
        fs::write(self.folder.join("summary.json"), text).map_err(|e| format!("cannot write summary.json: {e}"))
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
