//! The same growth rates from runs: a lattice starts in one wave of its theory, the passes of the program step it, and
//! the wave's amplitude tells its rate.
//!
//! An Eulerian body fills a periodic box and runs on the CPU path as any scene does. A Total Lagrangian one in a state
//! that no scene can begin with runs in [`super::halo`].

use super::halo;
use super::setting::Setting;
use crate::backend::{Choice, open};
use crate::fields::{Field, Type};
use crate::method::Integrator;
use crate::rows::Fault;
use crate::scene::Scene;
use crate::scene::file::{File, Motion, Time, Wave};
use crate::scene::shape::Coordinates;
use crate::study::von_neumann::Mode;
use crate::tensor::{Line, Plane, Solid};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_4, PI};

/// A wave in theory and in a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub wave: [f64; 3],
    pub theory: Mode,
    /// Growth rate, 1/time; 0 for a wave that swings. Negative where the run dissipates.
    pub rate: f64,
    /// Angular frequency, 1/time.
    pub frequency: f64,
    /// Measured less theoretical rate (frequency of a wave that swings, distance of the exponents where it also fades)
    /// over the latter, or over a hundredth of the largest frequency where that is more.
    pub difference: f64,
}

/// Amplitude of the velocity over c at the start: displacements stay below 1e-4 spacings.
const SEED: f64 = 1e-8;
/// Times at which the amplitude is taken, after the start.
const SAMPLES: usize = 24;
/// e-foldings, or radians, that are followed.
const FOLLOWED: [f64; 2] = [4.0, 8.0];
/// e-foldings of the fastest wave after which its share of rounding would show.
const LONGEST: f64 = 20.0;
/// Steps times the rate or frequency: leapfrog errs by its square over 24.
const FINE: f64 = 0.15;

/// How long a wave is followed, and in what steps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    pub step: f64,
    /// Between samples.
    pub steps: u32,
}

/// Runs the fastest growing, or else slowest motion of a wave that fits a periodic box of `cells` particles a side.
///
/// # Errors
/// One sentence where the wave grows and swings at once, or the run fails.
pub fn simulate(setting: &Setting, cells: usize, wave: [f64; 3]) -> Result<Measured, String> {
    let theory = setting.mode(wave);
    let zone = setting.wave_vectors(cells.min(if setting.dimension == 3 { 16 } else { 48 }));
    let highest = setting.waves().largest_frequency(&zone).max(setting.unit_rate());
    let floor = 0.01 * highest;
    if theory.rate.min(theory.frequency) > 1e-3 * floor {
        return Err(format!("the wave {wave:?} grows and swings at once: its run is not simulated"));
    }
    let fastest = setting.fastest(&zone).map_or(0.0, |(_, mode)| mode.rate);
    let scale = theory.rate.abs().max(theory.frequency).max(floor);
    let followed = if theory.rate > 0.0 { FOLLOWED[0] } else { FOLLOWED[1] } / scale;
    let between = followed.min(LONGEST / fastest.max(f64::MIN_POSITIVE)) / SAMPLES as f64;
    let longest = (FINE / scale).min(1.0 / highest);
    let steps = (between / longest).ceil().max(1.0);
    let course = Course { step: between / steps, steps: steps as u32 };
    let start = Start::new(setting, cells, wave, &theory);
    let amplitudes = match (setting.state, setting.dimension) {
        (None, _) => eulerian(setting, &start, course)?,
        (Some(_), 1) => halo::amplitudes::<Line<f64>>(setting, &start, course)?,
        (Some(_), 2) => halo::amplitudes::<Plane<f64>>(setting, &start, course)?,
        (Some(_), _) => halo::amplitudes::<Solid<f64>>(setting, &start, course)?,
    };
    let (rate, frequency) = exponent(&amplitudes, between, setting.dissipates());
    let difference = match theory.rate > 0.0 {
        true => rate - theory.rate - frequency,
        false if setting.dissipates() => (rate - theory.rate).hypot(frequency - theory.frequency),
        false => frequency - rate - theory.frequency,
    } / scale;
    Ok(Measured { wave, theory, rate, frequency, difference })
}

/// Rate and frequency of what the samples are a sum of: exp(+-lambda t), of which each obeys
/// s(t + d) + s(t - d) = 2 cosh(lambda d) s(t). With damping the two exponents differ.
fn exponent(samples: &[f64], between: f64, damped: bool) -> (f64, f64) {
    let mut sums = [[0.0; 2]; 2];
    let mut right = [0.0; 2];
    for s in samples.windows(3) {
        for (i, a) in [s[1], s[0]].into_iter().enumerate() {
            right[i] += a * s[2];
            sums[i][0] += a * s[1];
            sums[i][1] += a * s[0];
        }
    }
    let (twice_cosh, product) = if damped {
        let determinant = sums[0][0] * sums[1][1] - sums[0][1] * sums[1][0];
        if determinant <= 1e-12 * sums[0][0] * sums[1][1] {
            // One exponent alone.
            return ((right[0] / sums[0][0]).ln() / between, 0.0);
        }
        let a = (right[0] * sums[1][1] - right[1] * sums[0][1]) / determinant;
        let b = (right[1] * sums[0][0] - right[0] * sums[1][0]) / determinant;
        (a, -b)
    } else {
        ((right[0] + sums[0][1]) / sums[0][0], 1.0)
    };
    // Roots of z^2 - a z + product.
    let discriminant = 0.25 * twice_cosh * twice_cosh - product;
    if discriminant >= 0.0 {
        return ((0.5 * twice_cosh + discriminant.sqrt()).ln() / between, 0.0);
    }
    (0.5 * product.ln() / between, (-discriminant).sqrt().atan2(0.5 * twice_cosh) / between)
}

/// A standing wave of small velocities.
pub(super) struct Start {
    pub wave: DVec3,
    pub direction: DVec3,
    /// Particles along each axis of the least box that it fits.
    pub counts: [usize; 3],
    amplitude: f64,
}

impl Start {
    fn new(setting: &Setting, cells: usize, wave: [f64; 3], theory: &Mode) -> Self {
        // An Eulerian box must be longer than three reaches of its list.
        let reach = setting.smoothing_length() * (2.0 + setting.file.list_margin());
        let least = if setting.state.is_some() { 1 } else { (3.02 * reach / setting.spacing()).ceil() as usize };
        let counts = std::array::from_fn(|axis| {
            if axis >= setting.dimension {
                return 1;
            }
            let number = (wave[axis] * cells as f64 * setting.spacing() / (2.0 * PI)).round() as i64;
            let period = cells / common_divisor(number.unsigned_abs() as usize, cells);
            period * least.div_ceil(period)
        });
        let direction = DVec3::from(theory.polarisation);
        Self { wave: wave.into(), direction, counts, amplitude: SEED * setting.sound_speed() }
    }

    /// The setting's scene with this motion.
    pub fn scene(&self, setting: &Setting, course: Course, mut file: File) -> Result<Scene, String> {
        let vector = |v: DVec3| Coordinates(v.to_array()[..setting.dimension].to_vec());
        let amplitude = vector(self.direction * self.amplitude);
        file.body[0].motion = Some(Motion::Wave(Wave { amplitude, wave_vector: vector(self.wave), phase: FRAC_PI_4 }));
        file.time = Time { integrator: Integrator::Leapfrog, step: Some(course.step), ..Time::default() };
        file.duration = course.step * f64::from(course.steps) * SAMPLES as f64;
        parsed(&file)
    }

    /// sin(k.x + phase): at the edge of the zone a sine without phase is zero on every particle.
    fn sine(&self, x: DVec3) -> f64 {
        (self.wave.dot(x) + FRAC_PI_4).sin()
    }

    /// The wave's part in the velocities of particles at the positions, over that at the start.
    pub fn part(&self, particles: impl Iterator<Item = (DVec3, DVec3)>) -> f64 {
        let (mut sum, mut square) = (0.0, 0.0);
        for (position, velocity) in particles {
            let sine = self.sine(position);
            sum += sine * velocity.dot(self.direction);
            square += sine * sine;
        }
        sum / (square * self.amplitude * self.direction.length_squared())
    }
}

fn common_divisor(a: usize, b: usize) -> usize {
    if a == 0 { b } else { common_divisor(b % a, a) }
}

/// A scene from its tables.
pub(super) fn parsed(file: &File) -> Result<Scene, String> {
    Scene::from_file(file.clone(), "lattice")
}

/// The amplitude at the start and after each part of the course.
fn eulerian(setting: &Setting, start: &Start, course: Course) -> Result<Vec<f64>, String> {
    let mut file = setting.file.clone();
    file.body[0].shape = setting.block(0, start.counts);
    file.periodic = Some((0..setting.dimension).map(|axis| start.counts[axis] as f64 * setting.spacing()).collect());
    let scene = start.scene(setting, course, file)?;
    let mut backend = open(&scene, &Choice::Cpu)?;
    let between = course.step * f64::from(course.steps);
    let mut amplitudes = vec![1.0];
    for sample in 0..SAMPLES {
        backend.begin_segment(sample as f64 * between, between, u32::MAX, sample == 0)?;
        loop {
            let clock = backend.advance()?;
            if let Some(fault) = Fault::from_number(clock.fault) {
                return Err(format!("the run of the wave {} fails: {}", start.wave, fault.sentence()));
            }
            if clock.running == 0 {
                break;
            }
        }
        let columns = backend.fetch(&[Field::Number, Field::Velocity])?;
        let width = Type::Vec.words_in(setting.dimension);
        let velocity = |i: usize| {
            let of = &columns[&Field::Velocity][i * width..];
            DVec3::from_array(std::array::from_fn(|axis| if axis < setting.dimension { of[axis] } else { 0.0 }))
        };
        let position = |number: f64| scene.particles[number as usize].position;
        let particles = columns[&Field::Number].iter().enumerate().map(|(i, &number)| (position(number), velocity(i)));
        amplitudes.push(start.part(particles));
    }
    Ok(amplitudes)
}

/// Samples of a course.
pub(super) const fn samples() -> usize {
    SAMPLES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_found_from_their_sums() {
        let sampled = |of: &dyn Fn(f64) -> f64| (0..=SAMPLES).map(|k| of(0.2 * k as f64)).collect::<Vec<f64>>();
        let near = |(rate, frequency): (f64, f64), expected: (f64, f64)| {
            assert!((rate - expected.0).abs() < 1e-9 && (frequency - expected.1).abs() < 1e-9, "{rate} {frequency}");
        };
        near(exponent(&sampled(&|t| (0.7 * t).cosh()), 0.2, false), (0.7, 0.0));
        near(exponent(&sampled(&|t| (1.3 * t).cos()), 0.2, false), (0.0, 1.3));
        near(exponent(&sampled(&|t| (1.3 * t + 0.4).cos() * (-0.1 * t).exp()), 0.2, true), (-0.1, 1.3));
        near(exponent(&sampled(&|t| (0.7 * t).exp() + 0.3 * (-0.9 * t).exp()), 0.2, true), (0.7, 0.0));
        near(exponent(&sampled(&|_| 1.0), 0.2, false), (0.0, 0.0));
        near(exponent(&sampled(&|t| (-0.3 * t).exp()), 0.2, true), (-0.3, 0.0));
    }
}
