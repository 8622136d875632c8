//! Accuracy against cost: a scene runs over a matrix of settings, and each run becomes a row of a CSV with the
//! setting, the error against what the scene expects, and what it took.
//!
//! An error is what the scene's own tolerance bounds ([`check::error`]): a fraction where the expectation is
//! `relative`, else in the observable's unit. Beside it stand fractions ([`ErrorKind`]), by one of which settings are judged:
//! on a chart of error against cost, in the table of the cheapest for each error, and where one is recommended. The rows of a file are not run again, so that the same command goes on
//! where a kill left it. A run that failed has its row too.

pub(super) mod axis;
mod chart;
mod front;
mod kind;
pub(super) mod matrix;
mod measure;
mod names;
pub(super) mod recommend;
pub(super) mod report;
pub(super) mod row;
pub(super) mod source;
pub(super) mod table;
mod usual;

#[cfg(test)]
mod tests;

use crate::backend::{Choice, device};
use crate::check;
use crate::run::{self, Finished, INTERRUPTED, Options, Stop};
use crate::scene::Scene;
use axis::one_line;
use matrix::{Matrix, Setting, VARIANT};
use measure::Measures;
use report::Progress;
use row::Row;
use source::Source;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use table::{Header, Table};

pub use kind::ErrorKind;
pub use recommend::parse_error;
pub use row::Cost;

/// What the command line asks of a study.
#[derive(Debug, Clone, Default)]
pub struct Request {
    pub scene: PathBuf,
    pub variant: Option<String>,
    /// `path=value,value` for each axis; the scene's own matrix, or else the usual one, where empty.
    pub vary: Vec<String>,
    /// Each of [`Choice::Cpu`], [`Choice::Cpu32`], [`Choice::Gpu`].
    pub backends: Vec<Choice>,
    /// The expectation by whose error settings are judged; see [`Measures`].
    pub observable: Option<String>,
    /// By which of its fractions settings are judged; by the expectation's own norm unless given.
    pub kind: Option<ErrorKind>,
    pub repeats: u32,
    /// `out/study/SCENE[-VARIANT]-accuracy.csv` unless given.
    pub out: Option<PathBuf>,
    pub force: bool,
}

/// A study that can begin: every setting is a scene, every reference there.
pub struct Study {
    source: Source,
    /// The first variant that runs, without overrides: what it expects is measured.
    base: Scene,
    matrix: Matrix,
    measures: Measures,
    header: Header,
    /// In the order of their runs.
    jobs: Vec<Job>,
    label: String,
    file: PathBuf,
    /// Of the pictures and the page.
    stem: PathBuf,
    force: bool,
}

struct Job {
    setting: usize,
    choice: Choice,
    key: Vec<String>,
}

impl Study {
    /// # Errors
    /// One sentence on whatever would stop a run before its first step.
    pub fn plan(request: &Request) -> Result<Self, String> {
        let source = Source::new(request.scene.clone(), request.variant.clone())?;
        let scene = source.open(&[])?;
        let matrix = Matrix::new(&request.vary, &source.read()?, |overrides| source.open(overrides))?;
        if request.variant.is_some() && matrix.paths.iter().any(|path| path == VARIANT) {
            return Err("the matrix goes over the scene's variants: leave --variant out, or name other axes with --vary".into());
        }
        let base = match matrix.settings.first().and_then(Setting::variant) {
            Some(variant) => source.open(&[variant])?,
            None => scene.clone(),
        };
        let measures = Measures::new(&base, request.observable.as_deref(), request.kind)?;
        check::references(&base.file, source.folder())?;
        if request.backends.iter().any(|choice| matches!(choice, Choice::Gpu(_))) {
            device::choose(device::Want::Gpu, None)?;
        }
        let errors = measures.columns();
        let count = errors.len();
        let header =
            Header { stamp: source.stamp("accuracy", &scene)?, columns: row::columns(&matrix.paths, errors), errors: count };
        let (label, jobs) = (scene.label(), jobs(&matrix.settings, &request.backends, request.repeats));
        let file = request.out.clone().unwrap_or_else(|| format!("out/study/{label}-accuracy.csv").into());
        let stem = stem(&file, request);
        Ok(Self { source, base, matrix, measures, header, jobs, label, file, stem, force: request.force })
    }

    /// What is about to run.
    pub fn announcement(&self) -> String {
        let (settings, paths) = (self.matrix.settings.len(), self.matrix.paths.join(", "));
        let file = self.file.display();
        let line = format!("{}: {settings} settings of {paths}; {} runs, into {file}", self.label, self.jobs.len());
        match &self.matrix.left_out {
            Some((count, reason)) => format!("{line}\n{count} settings are left out, the first because {reason}"),
            None => line,
        }
    }

    /// Runs what the file lacks; draws the charts beside it; gives the table for the end.
    ///
    /// # Errors
    /// The file is of another study or cannot be written, or the user stops the study. A run that fails is a row.
    pub fn run(&self) -> Result<String, Stop> {
        let rows = self.rows()?;
        let told = chart::Told { title: &self.base.file.title, paths: &self.matrix.paths, measures: &self.measures, rows: &rows };
        let drawn = told.write(&self.stem).map_err(Stop::Failed)?;
        Ok(format!("{}{drawn}", report::text(&self.matrix.paths, &self.measures, &rows)))
    }

    /// Runs what the file lacks; gives all rows.
    fn rows(&self) -> Result<Vec<Row>, Stop> {
        let keys: HashSet<&Vec<String>> = self.jobs.iter().map(|job| &job.key).collect();
        let wanted = |row: &Row| keys.contains(&row.key);
        let mut table = Table::open(&self.file, &self.header, &wanted, self.force).map_err(Stop::Refused)?;
        let mut progress = Progress::new(self.jobs.len(), table.rows.len());
        for job in &self.jobs {
            if table.holds(&job.key) {
                continue;
            }
            let Some(row) = self.row(job)? else { return Err(self.interrupted(table.rows.len())) };
            progress.tell(table.append(row).map_err(Stop::Failed)?);
        }
        Ok(table.rows)
    }

    /// Runs a job; `None` where the user stops it.
    fn row(&self, job: &Job) -> Result<Option<Row>, Stop> {
        // A run looks for an interrupt itself; between two runs it must be looked for here.
        if INTERRUPTED.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let scene = self.source.open(&self.matrix.settings[job.setting].overrides).map_err(Stop::Refused)?;
        let options =
            Options { choice: job.choice.clone(), dry: true, quiet: true, energy: Options::UNWATCHED, ..Options::default() };
        Ok(match run::run(&scene, &options) {
            Ok(finished) => Some(self.finished(job.key.clone(), &scene, &finished)),
            Err(Stop::Interrupted(_)) => None,
            // A run that fails becomes a row, so that the study goes on with the others.
            Err(Stop::Failed(reason) | Stop::Refused(reason)) => Some(Row {
                key: job.key.clone(),
                cost: None,
                errors: vec![None; self.header.errors],
                status: format!("failed: {}", one_line(&reason)),
            }),
        })
    }

    fn finished(&self, key: Vec<String>, scene: &Scene, finished: &Finished) -> Row {
        let (errors, status) = self.measures.measure(scene, &self.base, finished, self.source.folder());
        Row { key, cost: Some(row::cost(finished)), errors, status }
    }

    fn interrupted(&self, rows: usize) -> Stop {
        let (runs, file) = (self.jobs.len(), self.file.display());
        Stop::Interrupted(format!("interrupted with {rows} of {runs} runs in {file}; the same command goes on from there"))
    }
}

/// Path without ending of the pictures and the page: the stem of the CSV, followed by the expectation and the kind of error by
/// which settings are judged, where the command line names them.
fn stem(file: &Path, request: &Request) -> PathBuf {
    let stem = file.file_stem().unwrap_or_default().display().to_string();
    let judged = request.observable.clone().into_iter().chain(request.kind.map(|kind| kind.word().to_string()));
    file.with_file_name([stem].into_iter().chain(judged).collect::<Vec<_>>().join("-"))
}

/// All runs, repeat by repeat: each setting runs once on each backend before any runs again, so that a time in which the machine
/// is slow does not fall on one setting alone.
fn jobs(settings: &[Setting], backends: &[Choice], repeats: u32) -> Vec<Job> {
    let mut jobs: Vec<Job> = Vec::new();
    for repeat in 1..=repeats {
        for (setting, values) in settings.iter().enumerate() {
            let job = |choice: &Choice| Job { setting, choice: choice.clone(), key: row::key(values, choice, repeat) };
            jobs.extend(backends.iter().map(job));
        }
    }
    jobs
}
