//! What a scene used and cost.

use super::{balance, watch};
use crate::backend::Backend;
use crate::backend::cpu::processor_seconds;
use crate::rows::Clock;
use crate::scene::{BodyMass, Scene};
use crate::step;
use serde_json::json;
use std::time::{Duration, Instant};

/// Measures wall and processor time from the run's first step, when the backend is open already.
pub struct Stopwatch {
    begin: Instant,
    /// Processor seconds that this process had used before the run.
    processor: f64,
    /// Wall and processor seconds of the run before it was broken off.
    before: [f64; 2],
}

impl Stopwatch {
    pub fn start() -> Self {
        Self { begin: Instant::now(), processor: processor_seconds(), before: [0.0; 2] }
    }

    /// Goes on where a run was broken off, after so many seconds of wall and of processor time.
    pub fn go_on(&mut self, before: [f64; 2]) {
        self.before = before;
    }

    /// Seconds of wall and of processor time.
    pub fn spent(&self) -> [f64; 2] {
        [self.before[0] + self.begin.elapsed().as_secs_f64(), self.before[1] + processor_seconds() - self.processor]
    }

    /// Wall time since the start.
    pub fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }
}

/// How long the steps of a run were.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLengths {
    /// Times; infinity and 0 before the first step.
    pub shortest: f64,
    pub longest: f64,
    /// How often a step was more than a hundredth longer or shorter than the one before.
    pub changes: u32,
}

impl Default for StepLengths {
    fn default() -> Self {
        Self { shortest: f64::INFINITY, longest: 0.0, changes: 0 }
    }
}

impl StepLengths {
    /// What a clock says after some steps.
    pub fn see(&mut self, clock: &Clock<f64>) {
        if clock.held > 0.0 {
            (self.shortest, self.longest) = (self.shortest.min(clock.held), self.longest.max(clock.held));
        }
        self.changes = clock.changes;
    }

    fn text(&self) -> String {
        if self.longest == 0.0 {
            return String::new();
        }
        if self.longest < 1.01 * self.shortest {
            return format!(" of {:.4e}", self.longest);
        }
        format!(" of {:.4e} to {:.4e}, which changed {} times", self.shortest, self.longest, self.changes)
    }
}

/// Cost of a run.
#[derive(Debug, Clone)]
pub struct Summary {
    pub device: String,
    pub particles: usize,
    /// Mean number of neighbours within the list's reach over all particles, at the end.
    pub neighbors: f64,
    pub steps: u32,
    pub lists_built: u32,
    pub lengths: StepLengths,
    pub passes: Vec<&'static str>,
    pub fields: Vec<&'static str>,
    pub bytes: u64,
    /// Seconds of wall time.
    pub seconds: f64,
    /// Processor seconds on all threads of this process, those of a software driver included.
    pub processor_seconds: f64,
    /// Steps times the force passes of a step, and one for each load step.
    pub force_evaluations: u64,
    pub said: Said,
}

/// What a run has counted.
#[derive(Debug, Clone, Copy)]
pub struct Counted {
    pub steps: u32,
    pub lists_built: u32,
    pub lengths: StepLengths,
    /// See [`Summary::neighbors`].
    pub neighbors: f64,
}

/// What a run says of itself beside the results.
#[derive(Debug, Clone)]
pub struct Said {
    /// What was said to standard error.
    pub warnings: Vec<String>,
    pub energy: watch::Report,
    /// Balance of forces, where equilibrium is sought.
    pub balance: Option<balance::Report>,
}

impl Summary {
    pub fn new(scene: &Scene, backend: &dyn Backend, counted: Counted, watch: &Stopwatch, said: Said) -> Self {
        let Counted { steps, lists_built, lengths, neighbors } = counted;
        let [seconds, processor_seconds] = watch.spent();
        let forces = step::step(&scene.groups()[0].method).iter().filter(|call| call.pass.is_force()).count() as u64;
        let begun = scene.file.quasi_static.as_ref().map_or(0, |typed| u64::from(typed.load_steps));
        let particles = scene.particles.len();
        let passes = step::passes_of(&scene.methods());
        Self {
            device: backend.describe(),
            particles,
            neighbors,
            steps,
            lists_built,
            lengths,
            passes: passes.iter().map(|pass| pass.name()).collect(),
            fields: scene.fields().iter().map(|f| f.name()).collect(),
            bytes: backend.bytes(),
            seconds,
            processor_seconds,
            force_evaluations: u64::from(steps) * forces + begun,
            said,
        }
    }

    /// Particle-steps per second of wall time, outputs included.
    pub fn updates_per_second(&self) -> f64 {
        self.particles as f64 * f64::from(self.steps) / self.seconds
    }

    pub fn text(&self) -> String {
        let costs = format!(
            "{} particles with {:.1} neighbours, {} passes a step, {:.0} bytes a particle\n\
             {}\n\
             {} steps{}, {} neighbour lists, {:.2} s: {:.3e} particle-updates a second",
            self.particles,
            self.neighbors,
            self.passes.len(),
            self.bytes as f64 / self.particles as f64,
            self.device,
            self.steps,
            self.lengths.text(),
            self.lists_built,
            self.seconds,
            self.updates_per_second(),
        );
        let lines = [Some(costs), Some(self.said.energy.text()), self.said.balance.as_ref().map(|balance| balance.text.clone())];
        lines.into_iter().flatten().collect::<Vec<_>>().join("\n")
    }

    pub fn json(&self, scene: &Scene) -> String {
        let value = json!({
            "scene": scene.name, "variant": scene.variant, "title": scene.file.title, "version": env!("CARGO_PKG_VERSION"),
            "device": self.device, "particles": self.particles, "neighbors": self.neighbors, "steps": self.steps,
            "lists_built": self.lists_built, "shortest_step": self.lengths.shortest, "longest_step": self.lengths.longest,
            "changes_of_step": self.lengths.changes, "passes": self.passes, "fields": self.fields, "bytes": self.bytes,
            "seconds": self.seconds, "processor_seconds": self.processor_seconds,
            "force_evaluations": self.force_evaluations, "particle_updates_per_second": self.updates_per_second(),
            "warnings": self.said.warnings, "energy": self.said.energy.json(), "balance": self.said.balance.as_ref().map(balance::Report::json),
            "bodies": scene.masses().iter().map(BodyMass::json).collect::<Vec<_>>(),
        });
        format!("{value:#}\n")
    }
}
