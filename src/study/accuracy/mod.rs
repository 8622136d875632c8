//! Accuracy against cost: a scene runs over a matrix of settings, and each run becomes a row of a CSV with the
//! setting, the error against what the scene expects, and what it took.
//!
//! An error is what the scene's own tolerance bounds ([`check::error`]): a fraction where the expectation is
//! `relative`, else in the observable's unit. The rows of a file are not run again, so that the same command goes on
//! where a kill left it. A run that failed has its row too.

mod front;
pub(super) mod matrix;
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
use front::Expected;
use matrix::{Matrix, Setting, one_line};
use report::Progress;
use row::{OK, Row};
use source::{Source, expected};
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use table::{Header, Table};

/// What the command line asks of a study.
#[derive(Debug, Clone, Default)]
pub struct Request {
    pub scene: PathBuf,
    pub variant: Option<String>,
    /// `path=value,value` for each axis; the scene's own matrix, or else the usual one, where empty.
    pub vary: Vec<String>,
    /// Each of [`Choice::Cpu`], [`Choice::Cpu32`], [`Choice::Gpu`].
    pub backends: Vec<Choice>,
    /// The only expectation whose error is measured; all unless given.
    pub observable: Option<String>,
    pub repeats: u32,
    /// `out/study/SCENE[-VARIANT]-accuracy.csv` unless given.
    pub out: Option<PathBuf>,
    pub force: bool,
}

/// A study that can begin: every setting is a scene, every reference there.
pub struct Study {
    source: Source,
    matrix: Matrix,
    expected: Vec<Expected>,
    header: Header,
    /// In the order of their runs.
    jobs: Vec<Job>,
    label: String,
    file: PathBuf,
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
        let expected = expected(&scene, request.observable.as_deref())?;
        check::references(&scene, source.folder())?;
        let matrix = Matrix::new(&request.vary, &source.read()?, |overrides| source.open(overrides))?;
        if request.backends.iter().any(|choice| matches!(choice, Choice::Gpu(_))) {
            device::choose(device::Want::Gpu, None)?;
        }
        let columns = row::columns(&matrix.paths, expected.iter().map(|expected| expected.name.as_str()));
        let header = Header { stamp: source.stamp("accuracy", &scene)?, columns, errors: expected.len() };
        let (label, jobs) = (scene.label(), jobs(&matrix.settings, &request.backends, request.repeats));
        let file = request.out.clone().unwrap_or_else(|| format!("out/study/{label}-accuracy.csv").into());
        Ok(Self { source, matrix, expected, header, jobs, label, file, force: request.force })
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

    /// Runs what the file lacks; gives the table for the end.
    ///
    /// # Errors
    /// The file is of another study or cannot be written, or the user stops the study. A run that fails is a row.
    pub fn run(&self) -> Result<String, Stop> {
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
        Ok(report::text(&self.matrix.paths, &self.expected, &table.rows))
    }

    /// Runs a job; `None` where the user stops it.
    fn row(&self, job: &Job) -> Result<Option<Row>, Stop> {
        // Between two runs nobody else looks.
        if INTERRUPTED.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let scene = self.source.open(&self.matrix.settings[job.setting].overrides).map_err(Stop::Refused)?;
        let options = Options { choice: job.choice.clone(), dry: true, quiet: true, ..Options::default() };
        Ok(match run::run(&scene, &options) {
            Ok(finished) => Some(self.finished(job.key.clone(), &scene, &finished)),
            Err(Stop::Interrupted(_)) => None,
            // The study shall not be lost for one run of many.
            Err(Stop::Failed(reason) | Stop::Refused(reason)) => Some(Row {
                key: job.key.clone(),
                cost: None,
                errors: vec![None; self.expected.len()],
                status: format!("failed: {}", one_line(&reason)),
            }),
        })
    }

    fn finished(&self, key: Vec<String>, scene: &Scene, finished: &Finished) -> Row {
        let error = |expected: &Expected| match scene.file.expect.get(&expected.name) {
            Some(expect) => check::error(scene, finished, self.source.folder(), &expected.name, expect),
            None => Err(format!("{}: this setting takes it away", expected.name)),
        };
        let errors: Vec<Result<f64, String>> = self.expected.iter().map(error).collect();
        let wrong = errors.iter().find_map(|error| error.as_ref().err());
        let status = wrong.map_or_else(|| OK.to_string(), |reason| format!("no error: {}", one_line(reason)));
        Row { key, cost: Some(row::cost(finished)), errors: errors.into_iter().map(Result::ok).collect(), status }
    }

    fn interrupted(&self, rows: usize) -> Stop {
        let (runs, file) = (self.jobs.len(), self.file.display());
        Stop::Interrupted(format!("interrupted with {rows} of {runs} runs in {file}; the same command goes on from there"))
    }
}

/// Each setting on each backend once, then again: what slows the machine for a while falls on all alike.
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
