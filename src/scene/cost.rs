//! What a run will take, said before it starts.

use super::Scene;

/// Particle-updates from which on a run is worth a warning: minutes on a few cores.
const MUCH: f64 = 1e9;
/// Steps that a descent takes to equilibrium, about.
const DESCENT: f64 = 300.0;

impl Scene {
    /// One line for a large run: particles, memory in single and double precision, steps.
    pub fn cost(&self) -> Option<String> {
        let (particles, steps) = (self.particles.len() as f64, self.likely_steps());
        if particles * steps < MUCH {
            return None;
        }
        let gigabytes = |word| self.run_bytes(word, word == 4) as f64 / 1e9;
        Some(format!(
            "{particles:.0} particles take {:.1} GB on a GPU, {:.1} GB on the CPU; about {steps:.0} steps, {:.1e} particle-updates",
            gigabytes(4),
            gigabytes(8),
            particles * steps
        ))
    }

    /// Bytes that the columns of all members of a run take where a number has `word` bytes.
    pub fn run_bytes(&self, word: usize, compensated: bool) -> u64 {
        self.members().map(|member| member.state_bytes(word, compensated)).sum()
    }

    /// Steps at the length that the first one has, that of the group whose step is the shortest.
    fn likely_steps(&self) -> f64 {
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
