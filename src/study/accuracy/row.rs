//! A row of the CSV: the setting of one run, what it cost, how wrong it was.

use super::matrix::Setting;
use crate::backend::Choice;
use crate::output::csv::shortest;
use crate::run::Finished;

/// Columns that tell how a setting was run; they stand between the varied paths and the numbers.
pub const RUN: [&str; 3] = ["backend", "precision", "repeat"];

/// Columns of what a run cost.
pub const COST: [&str; 8] =
    ["particles", "steps", "force_evaluations", "particle_updates", "cpu_seconds", "wall_seconds", "bytes", "bytes_per_particle"];

/// The cost by which a setting is judged beside its error, as the index of its column in [`COST`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Cost {
    ForceEvaluations = 2,
    /// Particles times force evaluations: the same on every machine.
    ParticleUpdates = 3,
    CpuSeconds = 4,
    WallSeconds = 5,
    Bytes = 6,
}

impl Cost {
    /// Name of its column.
    pub fn word(self) -> &'static str {
        COST[self as usize]
    }

    /// The cost in words, for titles and axes.
    pub fn about(self) -> String {
        self.word().replace('_', " ").replace("particle updates", "particle-updates").replace("cpu", "CPU")
    }
}

/// Status of a run that came to its end.
pub const OK: &str = "ok";

/// One run.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Values of the varied paths, then those of [`RUN`]: what tells the run from all others.
    pub key: Vec<String>,
    /// Numbers under [`COST`]; `None` where the run did not come to its end.
    pub cost: Option<[f64; COST.len()]>,
    /// One for each expectation.
    pub errors: Vec<Option<f64>>,
    /// [`OK`], or what went wrong.
    pub status: String,
}

/// What tells a run from all others.
pub fn key(setting: &Setting, choice: &Choice, repeat: u32) -> Vec<String> {
    let [backend, precision] = match choice {
        Choice::Cpu => ["cpu", "f64"],
        Choice::Cpu32 => ["cpu", "f32"],
        Choice::Auto | Choice::Gpu(_) => ["gpu", "f32"],
    };
    setting.shown.iter().cloned().chain([backend.into(), precision.into(), repeat.to_string()]).collect()
}

/// Names of all columns.
pub fn columns(paths: &[String], errors: Vec<String>) -> Vec<String> {
    let numbers = RUN.iter().chain(&COST).map(|name| (*name).to_string());
    paths.iter().cloned().chain(numbers).chain(errors).chain(["status".to_string()]).collect()
}

/// What a finished run cost.
pub fn cost(finished: &Finished) -> [f64; COST.len()] {
    let summary = &finished.summary;
    let (particles, evaluations, bytes) = (summary.particles as f64, summary.force_evaluations as f64, summary.bytes as f64);
    [
        particles,
        f64::from(summary.steps),
        evaluations,
        particles * evaluations,
        summary.processor_seconds,
        summary.seconds,
        bytes,
        bytes / particles,
    ]
}

impl Row {
    /// The setting and the backend, without the repeat.
    pub fn subject(&self) -> &[String] {
        &self.key[..self.key.len() - 1]
    }

    pub fn cost_of(&self, cost: Cost) -> Option<f64> {
        self.cost.map(|all| all[cost as usize])
    }

    pub fn cells(&self) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or_else(String::new, shortest);
        let cost = (0..COST.len()).map(|k| number(self.cost.map(|cost| cost[k])));
        let errors = self.errors.iter().map(|error| number(*error));
        self.key.iter().cloned().chain(cost).chain(errors).chain([self.status.clone()]).collect()
    }

    /// A row of a table with so many expectations.
    ///
    /// # Errors
    /// What is wrong, without its place.
    pub fn from_cells(cells: Vec<String>, columns: usize, errors: usize) -> Result<Self, String> {
        if cells.len() != columns {
            return Err(format!("{} values for {columns} columns", cells.len()));
        }
        let number = |text: &String| match text.as_str() {
            "" => Ok(None),
            text => text.parse().map(Some).map_err(|_| format!("{text:?} is not a number")),
        };
        let (paths, rest) = cells.split_at(columns - 1 - errors - COST.len());
        let numbers = rest[..COST.len() + errors].iter().map(number).collect::<Result<Vec<Option<f64>>, _>>()?;
        let (cost, errors) = numbers.split_at(COST.len());
        let cost = cost.iter().copied().collect::<Option<Vec<f64>>>().and_then(|cost| cost.try_into().ok());
        Ok(Self { key: paths.to_vec(), cost, errors: errors.to_vec(), status: rest[rest.len() - 1].clone() })
    }
}
