//! What a run left in its folder, and the numbers that measures are made of.

use crate::observable::{KINDS, Table, Value};
use crate::output::csv;
use crate::scene::Scene;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A run that came to its end or went wrong on the way.
#[derive(Debug)]
pub struct Outcome {
    pub scene: Scene,
    pub table: Table,
    /// Why the run ended before its time.
    pub stopped: Option<String>,
    folder: PathBuf,
}

impl Outcome {
    /// From the folder of a run.
    ///
    /// # Errors
    /// One sentence where there is no series.
    pub fn read(scene: Scene, folder: &Path) -> Result<Self, String> {
        let stopped = std::fs::read_to_string(folder.join(STOPPED)).ok();
        let (names, rows) = csv::read(&folder.join("series.csv"))?;
        let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let columns = names.iter().cloned().enumerate().skip(1).map(|(k, name)| (name, column(k))).collect();
        Ok(Self { scene, table: Table { times: column(0), columns }, stopped, folder: folder.into() })
    }

    /// All values of a series.
    pub fn series(&self, name: &str) -> Result<&[f64], String> {
        let column = self.table.columns.get(name).filter(|column| !column.is_empty());
        column.map(Vec::as_slice).ok_or_else(|| format!("the run left no series `{name}`"))
    }

    pub fn first(&self, name: &str) -> Result<f64, String> {
        Ok(self.series(name)?[0])
    }

    pub fn last(&self, name: &str) -> Result<f64, String> {
        let series = self.series(name)?;
        Ok(series[series.len() - 1])
    }

    /// NaN where one is.
    pub fn least(&self, name: &str) -> Result<f64, String> {
        Ok(self.series(name)?.iter().copied().fold(f64::INFINITY, extreme(f64::min)))
    }

    /// NaN where one is.
    pub fn most(&self, name: &str) -> Result<f64, String> {
        Ok(self.series(name)?.iter().copied().fold(f64::NEG_INFINITY, extreme(f64::max)))
    }

    /// Largest distance from the first value.
    pub fn drift(&self, name: &str) -> Result<f64, String> {
        let first = self.first(name)?;
        Ok((self.most(name)? - first).max(first - self.least(name)?))
    }

    /// A result that the scene observes.
    pub fn result(&self, name: &str) -> Result<f64, String> {
        let typed = self.scene.file.observe.get(name).ok_or_else(|| format!("the scene observes no `{name}`"))?;
        match KINDS.iter().find(|kind| kind.word == typed.kind).map(|kind| &kind.value) {
            Some(Value::Result(of)) => of(&self.table, typed),
            _ => Err(format!("`{name}` is no result")),
        }
    }

    /// The last picture that the run left.
    ///
    /// # Errors
    /// One sentence where there is none or it cannot be read.
    pub fn picture(&self) -> Result<image::RgbaImage, String> {
        let frames = self.folder.join("frames");
        let failed = |why: String| format!("{}: {why}", frames.display());
        let files = std::fs::read_dir(&frames).map_err(|e| failed(e.to_string()))?;
        let names = files.flatten().map(|file| file.path()).filter(|path| path.extension().is_some_and(|e| e == "png"));
        let last = names.max().ok_or_else(|| failed("no picture".into()))?;
        Ok(image::open(&last).map_err(|e| format!("{}: {e}", last.display()))?.to_rgba8())
    }
}

/// What tells that a run broke off, and why.
const STOPPED: &str = "stopped.txt";

/// Keeps in a run's folder why it broke off, or that it did not.
pub fn mark(folder: &Path, stopped: Option<&str>) -> Result<(), String> {
    let path = folder.join(STOPPED);
    let written = match stopped {
        Some(why) => std::fs::write(&path, why),
        None => std::fs::remove_file(&path).or_else(|e| if e.kind() == ErrorKind::NotFound { Ok(()) } else { Err(e) }),
    };
    written.map_err(|e| format!("cannot write {}: {e}", path.display()))
}

fn extreme(of: fn(f64, f64) -> f64) -> impl Fn(f64, f64) -> f64 {
    move |a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { of(a, b) }
}
