//! What a run will take, said before it starts.

use super::Scene;

/// Particle-updates from which on a run is worth a line: ten seconds or more on a few cores.
const MUCH: f64 = 2e7;
/// Particle-updates a second of two cores, about: see the table of speeds in `README.md`.
const TWO_CORES: f64 = 1.5e6;
/// Steps that a descent takes to equilibrium, about.
const DESCENT: f64 = 300.0;

/// Seconds in a unit that gives a number that can be read.
fn time(seconds: f64) -> String {
    let (unit, word) = match seconds {
        _ if seconds < 120.0 => (1.0, "s"),
        _ if seconds < 7200.0 => (60.0, "minutes"),
        _ if seconds < 172_800.0 => (3600.0, "hours"),
        _ => (86_400.0, "days"),
    };
    format!("{:.0} {word}", seconds / unit)
}

impl Scene {
    /// One line for a large run: particles, memory in single and double precision, steps.
    pub fn cost(&self) -> Option<String> {
        let (particles, steps) = (self.particles.len() as f64, self.likely_steps());
        if particles * steps < MUCH {
            return None;
        }
        let gigabytes = |word| self.run_bytes(word, word == 4) as f64 / 1e9;
        Some(format!(
            "{particles:.0} particles take {:.2} GB on a GPU, {:.2} GB on the CPU; about {steps:.0} steps, {:.1e} particle-updates, \
             which take two cores about {}",
            gigabytes(4),
            gigabytes(8),
            particles * steps,
            time(particles * steps / TWO_CORES)
        ))
    }

    /// Bytes that the columns of all members of a run take where a number has `word` bytes.
    pub fn run_bytes(&self, word: usize, compensated: bool) -> u64 {
        self.members().map(|member| member.state_bytes(word, compensated)).sum()
    }

    /// Steps at the length that the first one has, that of the group whose step is the shortest.
    pub(super) fn likely_steps(&self) -> f64 {
        self.groups().iter().map(Scene::likely_steps_alone).fold(0.0, f64::max)
    }

    fn likely_steps_alone(&self) -> f64 {
        let file = &self.file;
        if let Some(descent) = &file.quasi_static {
            return f64::from(descent.load_steps) * DESCENT;
        }
        let rate =
            |body: &super::SceneBody| body.material.sound_speed() * (1.0 + 0.6 * body.options.alpha) / body.smoothing_length;
        let wave = self.bodies.iter().map(rate).fold(0.0, f64::max);
        let step = file.time.step.unwrap_or(file.time.cfl / (wave * wave + self.contact_rate()).sqrt());
        file.duration / step
    }
}
