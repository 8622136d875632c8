//! The longest time step of each integrator, from the largest eigenvalue of the discrete equations and from runs.

use super::setting::Setting;
use super::simulate::parsed;
use crate::backend::Choice;
use crate::method::{Formulation, Integrator, Method};
use crate::run::{Options, Stop, run};
use crate::scene::Scene;
use crate::scene::file::{File, Kick, Motion, Observe, Time, Wave};
use crate::scene::shape::Coordinates;
use crate::step::{amplification, longest_step};
use std::f64::consts::FRAC_PI_4;

/// An integrator's longest step on a lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    pub integrator: Integrator,
    /// Largest omega dt at which an oscillator does not grow, from the passes of a step.
    pub formula: f64,
    /// Longest step in theory: `formula` over the largest angular frequency of the discrete equations.
    pub computed: f64,
    /// Longest step of which a thousand and more do not make a run grow.
    pub measured: f64,
}

impl Limit {
    pub fn ratio(&self) -> f64 {
        self.measured / self.computed
    }
}

/// Growth of the fastest oscillation at a step of an integrator that has no limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Secular {
    pub integrator: Integrator,
    /// Largest frequency times the step.
    pub omega_step: f64,
    /// Logarithm of the factor by which one step multiplies the amplitude of an oscillator, in theory.
    pub computed: f64,
    /// Logarithm of the factor by which one step multiplies the amplitude in a run.
    pub measured: f64,
}

/// Integrators that have a limit.
const LIMITED: [Integrator; 4] = [Integrator::Leapfrog, Integrator::SspRk3, Integrator::Rk4, Integrator::Pefrl];
/// Steps of a run, and how much faster it must become to count as unstable.
const STEPS: u32 = 2000;
const GROWN: f64 = 10.0;
/// Number of rows in which the speed surely has a peak: at the step of [`secular`] they last more than two periods.
const PEAK_ROWS: usize = 40;
/// Range of measured over computed limits that is searched, and how often it is halved.
const BRACKET: [f64; 2] = [0.8, 1.2];
const BISECTIONS: usize = 9;

/// Bisects the step of each integrator that has a limit, on a lattice at rest, kicked at one particle.
///
/// # Errors
/// One sentence where the lattice is unstable at any step, or damped.
pub fn limits(setting: &Setting, mut tell: impl FnMut(&Limit)) -> Result<Vec<Limit>, String> {
    let lattice = Kicked::new(setting)?;
    let of = |integrator: Integrator| {
        let formula = longest_step(&lattice.method, integrator);
        let computed = formula / lattice.highest;
        let measured = computed * lattice.bisected(integrator, computed)?;
        let limit = Limit { integrator, formula, computed, measured };
        tell(&limit);
        Ok(limit)
    };
    lattice.integrators().map(of).collect()
}

/// Growth of the second-order Runge-Kutta method, which has no stable step.
///
/// # Errors
/// As [`limits`].
pub fn secular(setting: &Setting) -> Result<Secular, String> {
    let lattice = Kicked::new(setting)?;
    let (integrator, omega_step) = (Integrator::Rk2, 0.5);
    let computed = amplification(&lattice.method, integrator, omega_step).ln();
    let measured = lattice.rate(integrator, omega_step / lattice.highest)?;
    Ok(Secular { integrator, omega_step, computed, measured })
}

/// Whether a setting has limits to measure.
///
/// # Errors
/// As [`limits`], without a run.
pub fn check(setting: &Setting) -> Result<(), String> {
    Kicked::new(setting).map(drop)
}

/// A periodic box at rest, one of whose particles is kicked.
struct Kicked {
    file: File,
    method: Method,
    highest: f64,
    /// Wave vector and direction of the fastest oscillation.
    fastest: ([f64; 3], [f64; 3]),
    speed: f64,
}

impl Kicked {
    fn new(setting: &Setting) -> Result<Self, String> {
        if setting.dissipates() || setting.file.formulation.xsph.is_some_and(|weight| weight > 0.0) {
            return Err("the limits are those of undamped equations: take viscosity, velocity_filter and xsph away".into());
        }
        if setting.state.is_some_and(|(deformation, damage)| deformation != glam::DMat3::IDENTITY || damage.along != [0.0; 3]) {
            return Err("the limits are measured on the body as runs begin: take [study.stability] away".into());
        }
        let reach = setting.smoothing_length() * (2.0 + setting.file.list_margin());
        let least = (3.02 * reach / setting.spacing()).ceil() as usize;
        // The number of cells is even, so that the shortest wave, at the edge of the Brillouin zone, is among the waves.
        let cells = least.max([32, 10, 10][setting.dimension - 1]).next_multiple_of(2);
        let vectors = setting.wave_vectors(cells);
        let highest = setting.waves().largest_frequency(&vectors);
        if setting.waves().fastest(&vectors).1 > 1e-6 * highest {
            return Err("a wave on the lattice grows at any step: --limits needs a state in which the lattice is stable".into());
        }
        let swings = |k: &[f64; 3]| setting.waves().modes(*k).pop().map(|mode| (*k, mode));
        let fastest = vectors.iter().filter_map(swings).max_by(|a, b| a.1.frequency.total_cmp(&b.1.frequency));
        let fastest = fastest.map(|(k, mode)| (k, mode.polarisation)).ok_or("the lattice has no wave")?;
        let mut file = setting.file.clone();
        let counts = std::array::from_fn(|axis| if axis < setting.dimension { cells } else { 1 });
        file.body[0].shape = setting.block(0, counts);
        file.periodic = Some(vec![cells as f64 * setting.spacing(); setting.dimension]);
        let speed = 1e-10 * setting.sound_speed();
        let list = |numbers: [f64; 3]| Coordinates(numbers[..setting.dimension].to_vec());
        file.kick = vec![Kick { at: list([0.0; 3]), velocity: list([speed, 0.7 * speed, 0.4 * speed]) }];
        let observe = Observe { kind: "rms_speed".into(), ..Observe::default() };
        file.observe.insert("speed".into(), observe);
        let method = parsed(&file)?.method;
        Ok(Self { file, method, highest, fastest, speed })
    }

    fn integrators(&self) -> impl Iterator<Item = Integrator> {
        let lagrangian = self.method.formulation == Formulation::TotalLagrangian;
        LIMITED.into_iter().filter(move |&integrator| lagrangian || integrator != Integrator::Pefrl)
    }

    fn scene(&self, integrator: Integrator, step: f64) -> Result<Scene, String> {
        let mut file = self.file.clone();
        file.time = Time { integrator, step: Some(step), ..Time::default() };
        file.duration = step * f64::from(STEPS);
        file.output.series = Some(file.duration / 40.0);
        parsed(&file)
    }

    fn grows(&self, integrator: Integrator, step: f64) -> Result<bool, String> {
        let speeds = speeds_of(&self.scene(integrator, step)?)?;
        let grown = |speeds: &[f64]| speeds.iter().any(|speed| !speed.is_finite()) || speeds.last() > Some(&(GROWN * speeds[0]));
        Ok(speeds.is_none_or(|speeds| grown(&speeds)))
    }

    /// The measured limit over the computed one.
    fn bisected(&self, integrator: Integrator, computed: f64) -> Result<f64, String> {
        let [mut low, mut high] = BRACKET;
        while self.grows(integrator, low * computed)? {
            (low, high) = (0.5 * low, low);
        }
        while !self.grows(integrator, high * computed)? {
            (low, high) = (high, 1.5 * high);
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if self.grows(integrator, middle * computed)? { high = middle } else { low = middle }
        }
        Ok(0.5 * (low + high))
    }

    /// ln of the growth a step of the fastest oscillation, seeded alone.
    fn rate(&self, integrator: Integrator, step: f64) -> Result<f64, String> {
        let mut scene = self.scene(integrator, step)?.file;
        let vector = |numbers: [f64; 3], by: f64| Coordinates(numbers[..scene.dimension].iter().map(|x| by * x).collect());
        // At the edge of the zone a sine without phase is zero on every particle.
        let (wave, direction) = self.fastest;
        let (amplitude, wave_vector) = (vector(direction, self.speed), vector(wave, 1.0));
        scene.kick.clear();
        scene.body[0].motion = Some(Motion::Wave(Wave { amplitude, wave_vector, phase: FRAC_PI_4 }));
        scene.output.series = Some(step);
        let speeds = speeds_of(&parsed(&scene)?)?.ok_or("the run of rk2 fails")?;
        // The speed swings: its peaks in the first and the last rows.
        let peak = |rows: &[f64]| rows.iter().copied().fold(0.0, f64::max);
        let rows = PEAK_ROWS.min(speeds.len() / 2);
        let (first, last) = (peak(&speeds[..rows]), peak(&speeds[speeds.len() - rows..]));
        Ok((last / first).ln() / (speeds.len() - rows) as f64)
    }
}

/// The speeds of a run; none where it fails.
fn speeds_of(scene: &Scene) -> Result<Option<Vec<f64>>, String> {
    let options = Options { choice: Choice::Cpu, dry: true, quiet: true, energy: Options::UNWATCHED, ..Options::default() };
    match run(scene, &options) {
        Ok(mut finished) => Ok(finished.table.columns.remove("speed")),
        Err(Stop::Failed(_)) => Ok(None),
        Err(Stop::Refused(reason) | Stop::Interrupted(reason)) => Err(reason),
    }
}
