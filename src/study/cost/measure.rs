//! Time of a step, from the first steps of a scene.

use crate::backend::cpu::processor_seconds;
use crate::backend::{Backend, Choice, open};
use crate::rows::{Clock, Fault};
use crate::run::Stop;
use crate::scene::Scene;
use std::time::Instant;

/// Looks at the clock, a tenth of a second or a step apart on the CPU; the best counts, since machines are shared.
const ROUNDS: usize = 4;

/// What a step took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Of wall time.
    pub seconds: f64,
    /// On all threads of this process.
    pub processor_seconds: f64,
    /// Of all tables, the distinct bonds that a CPU keeps too, as the backend has them.
    pub bytes: u64,
}

/// Steps a scene for a while from its start.
pub fn step(scene: &Scene, choice: &Choice) -> Result<Step, Stop> {
    let failed = |reason: String| Stop::Failed(format!("{}: {reason}", scene.label()));
    let mut backend = open(scene, choice).map_err(Stop::Refused)?;
    let mut best = Step { seconds: f64::INFINITY, processor_seconds: f64::INFINITY, bytes: 0 };
    let (mut seen, mut running) = (0, false);
    for round in 0..=ROUNDS {
        if !running {
            begin(scene, &mut *backend, round == 0).map_err(failed)?;
        }
        let (wall, used) = (Instant::now(), processor_seconds());
        let clock = advance(&mut *backend, seen).map_err(failed)?;
        let steps = f64::from(clock.steps_done - seen);
        (seen, running) = (clock.steps_done, clock.running == 1);
        // The first round warms caches and compiles shaders.
        if round > 0 {
            best.seconds = best.seconds.min(wall.elapsed().as_secs_f64() / steps);
            best.processor_seconds = best.processor_seconds.min((processor_seconds() - used) / steps);
        }
    }
    best.bytes = backend.bytes();
    Ok(best)
}

/// A segment to the end of the scene, or of its first load step.
fn begin(scene: &Scene, backend: &mut dyn Backend, first: bool) -> Result<(), String> {
    let (part, steps) = match &scene.file.quasi_static {
        Some(typed) => (1.0 / f64::from(typed.load_steps), typed.most_steps),
        None => (1.0, u32::MAX),
    };
    backend.begin_segment(0.0, part * scene.file.duration, steps, first)
}

/// At least one more step.
fn advance(backend: &mut dyn Backend, seen: u32) -> Result<Clock<f64>, String> {
    loop {
        let clock = backend.advance()?;
        if let Some(fault) = Fault::from_number(clock.fault) {
            return Err(format!("stopped at step {}: {}", clock.steps_done, fault.sentence()));
        }
        if clock.steps_done > seen {
            return Ok(clock);
        }
        if clock.running == 0 {
            return Err("a segment ended without a step".into());
        }
    }
}
