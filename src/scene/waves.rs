//! How fast sound is in a scene's materials, and whether its times and speeds go together. No physics makes the ratios that
//! are warned of here, but a number typed in another unit does: a density in kg/m^3 where the scene has t/mm^3 makes sound a
//! million times too slow, and a modulus in Pa where it has MPa a thousand times too fast.

use super::members::factor;
use super::refuse::Refuse;
use super::words::rounded;
use super::{Scene, SceneBody};
use glam::DVec3;

/// Spacings that sound travels in a run: with fewer, hardly a particle has felt its neighbours when the run is over. The least of
/// all scenes is 0.44, in a run that looks at the first moments of an instability.
const LEAST_SPACINGS: f64 = 0.1;
/// Times that sound crosses a body in a run: with more, steps are counted in millions. The most of all scenes is 6.8e3.
const MOST_CROSSINGS: f64 = 3e4;
/// Speed at which parts of a scene move against each other, over that of sound. The most of all scenes is 1.9, across a disc that
/// spins; contact by a gap lets discs through from 3.4 on.
const MOST_MACH: f64 = 3.0;

impl Scene {
    /// One line for each material, in the order of the bodies: the speed of longitudinal waves, and how long they take through
    /// the first body of it.
    pub fn wave_lines(&self) -> Vec<String> {
        let [length, _, time] = self.unit_names();
        let mut told: Vec<&str> = Vec::new();
        let mut lines = Vec::new();
        for (k, (typed, body)) in self.file.body.iter().zip(&self.bodies).enumerate() {
            if told.contains(&typed.material.as_str()) {
                continue;
            }
            told.push(&typed.material);
            let (speed, across) = (body.material.sound_speed(), self.longest_side(k));
            lines.push(format!(
                "`{}`: sound travels at {} {length}/{time} and through `{}`, {} {length} long, in {} {time}",
                typed.material,
                rounded(speed, 4),
                body.group,
                rounded(across, 4),
                rounded(across / speed, 3)
            ));
        }
        lines
    }

    /// One sentence for each ratio of the scene's times and speeds that makes no sense.
    pub(super) fn wave_warnings(&self, refuse: &Refuse) -> Vec<String> {
        // Pseudo-time has no waves.
        if self.file.quasi_static.is_some() {
            return Vec::new();
        }
        [self.slow_waves(refuse), self.fast_waves(refuse), self.outrun(refuse)].into_iter().flatten().collect()
    }

    fn slow_waves(&self, refuse: &Refuse) -> Option<String> {
        let [length, _, time] = self.unit_names();
        let (k, spacings) = self.extreme(|body, _| body.material.sound_speed() * self.file.duration / body.spacing, f64::lt)?;
        let (body, duration) = (&self.bodies[k], self.file.duration);
        let sentence = format!(
            "sound travels at {} {length}/{time} in `{}`, {} of a spacing in the whole run of {} {time}, so that it is over before \
             any part of the body feels another: {}",
            rounded(body.material.sound_speed(), 3),
            body.group,
            rounded(spacings, 2),
            rounded(duration, 4),
            self.units_to_check()
        );
        (spacings < LEAST_SPACINGS).then(|| refuse.at(&["material", &self.file.body[k].material, "density"], sentence))
    }

    fn fast_waves(&self, refuse: &Refuse) -> Option<String> {
        let [length, _, time] = self.unit_names();
        let of = |body: &SceneBody, long: f64| body.material.sound_speed() * self.file.duration / long;
        let (k, crossings) = self.extreme(of, f64::gt)?;
        let body = &self.bodies[k];
        let sentence = format!(
            "sound travels at {} {length}/{time} in `{}` and crosses it {} times in the run of {} {time}, which takes about \
             {:.0e} steps: {}",
            rounded(body.material.sound_speed(), 3),
            body.group,
            rounded(crossings, 2),
            rounded(self.file.duration, 4),
            self.likely_steps(),
            self.units_to_check()
        );
        (crossings > MOST_CROSSINGS).then(|| refuse.at(&["material", &self.file.body[k].material], sentence))
    }

    fn outrun(&self, refuse: &Refuse) -> Option<String> {
        let [length, _, time] = self.unit_names();
        let (k, _) = self.extreme(|body, _| body.material.sound_speed(), f64::lt)?;
        let (sound, speed) = (self.bodies[k].material.sound_speed(), self.closing_speed());
        let sentence = format!(
            "parts of the scene move against each other at {} {length}/{time}, {} times as fast as sound in `{}` ({} {length}/{time}): \
             no contact holds against that; {}",
            rounded(speed, 3),
            rounded(speed / sound, 2),
            self.bodies[k].group,
            rounded(sound, 3),
            self.units_to_check()
        );
        (speed > MOST_MACH * sound).then(|| refuse.at(&["material", &self.file.body[k].material], sentence))
    }

    /// The body with the least or the largest of a number that is found from it and its longest side.
    fn extreme(&self, of: impl Fn(&SceneBody, f64) -> f64, better: fn(&f64, &f64) -> bool) -> Option<(usize, f64)> {
        let all = self.bodies.iter().enumerate().map(|(k, body)| (k, of(body, self.longest_side(k))));
        all.reduce(|kept, next| if better(&next.1, &kept.1) { next } else { kept })
    }

    fn longest_side(&self, body: usize) -> f64 {
        let (low, high) = self.file.body[body].shape.bounds(self.dimension());
        (0..self.dimension()).map(|axis| (high - low)[axis]).fold(0.0, f64::max)
    }

    /// The largest difference along an axis between any two of the velocities that particles, boundaries and obstacles have.
    fn closing_speed(&self) -> f64 {
        let peak = |course: &[[f64; 2]]| {
            let within = course.iter().filter(|point| point[0] <= self.file.duration).map(|point| point[1].abs());
            if course.is_empty() { 1.0 } else { within.fold(factor(course, self.file.duration).abs(), f64::max) }
        };
        let driven = self.constraints.iter().map(|held| {
            let own = |axis: usize| if held.prescribed[axis] { peak(&held.course) * held.vector[axis] } else { 0.0 };
            DVec3::from_array(std::array::from_fn(own))
        });
        // What has a course is among the constraints.
        let obstacles =
            self.obstacles.iter().map(|obstacle| if obstacle.condition.is_some() { DVec3::ZERO } else { obstacle.velocity });
        let all = self.particles.iter().map(|particle| particle.velocity).chain(driven).chain(obstacles);
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = all.fold(start, |(low, high), velocity| (low.min(velocity), high.max(velocity)));
        (high - low).max_element()
    }

    /// Which units a scene has that its numbers may not.
    fn units_to_check(&self) -> String {
        let [length, mass, time] = self.unit_names();
        match self.file.units {
            super::file::Units::Dimensionless => "look at the density, the moduli, the speeds and the duration".into(),
            _ => {
                let stress = if length == "mm" { "MPa" } else { "Pa" };
                format!(
                    "look at the units, which are {mass}/{length}^3 for densities, {stress} for moduli, {length}/{time} for speeds and \
                     {time} for times"
                )
            }
        }
    }
}
