//! Initial velocity fields by name.

use super::file::{Cantilever, Motion, Twist, Wave};
use glam::DVec3;

/// First root of cos(k) cosh(k) = -1: wave number times length of a cantilever's first mode.
const FIRST_MODE: f64 = 1.875_104_068_711_961;

impl Motion {
    /// # Errors
    /// One sentence on what makes no motion.
    pub fn check(&self) -> Result<(), String> {
        let (axis, length) = match self {
            Motion::Cantilever(cantilever) => (&cantilever.axis, cantilever.length),
            Motion::Twist(twist) => (&twist.axis, twist.length),
            Motion::Gradient(_) | Motion::Wave(_) => return Ok(()),
        };
        if axis.vector().try_normalize().is_none() {
            return Err("the axis of a motion must point somewhere, not be zero".into());
        }
        if !(length > 0.0 && length.is_finite()) {
            return Err(format!("the length of a motion must be a positive number, found {length}"));
        }
        Ok(())
    }

    /// Velocity at a point of the body.
    pub fn velocity(&self, x: DVec3) -> DVec3 {
        match self {
            Motion::Gradient(rows) => {
                let row = |k: usize| rows.get(k).map_or(0.0, |r| r.iter().zip(x.to_array()).map(|(a, b)| a * b).sum());
                DVec3::new(row(0), row(1), row(2))
            }
            Motion::Wave(wave) => wave.at(x),
            Motion::Cantilever(cantilever) => cantilever.velocity(x),
            Motion::Twist(twist) => twist.velocity(x),
        }
    }
}

impl Wave {
    /// amplitude sin(wave_vector . x + phase)
    pub fn at(&self, x: DVec3) -> DVec3 {
        self.amplitude.vector() * (self.wave_vector.vector().dot(x) + self.phase).sin()
    }
}

impl Cantilever {
    fn velocity(&self, x: DVec3) -> DVec3 {
        let along = self.axis.vector().normalize_or_zero().dot(x - self.root.vector());
        let share = (along / self.length).clamp(0.0, 1.0);
        self.tip.vector() * (mode(FIRST_MODE * share) / mode(FIRST_MODE))
    }
}

/// Shape of the first mode at wave number times distance from the clamp, to a factor.
fn mode(s: f64) -> f64 {
    let (k, clamped) = (FIRST_MODE, s.cosh() - s.cos());
    clamped - (k.cosh() + k.cos()) / (k.sinh() + k.sin()) * (s.sinh() - s.sin())
}

impl Twist {
    fn velocity(&self, x: DVec3) -> DVec3 {
        let (axis, offset) = (self.axis.vector().normalize_or_zero(), x - self.root.vector());
        let share = (axis.dot(offset) / self.length).max(0.0);
        (axis * (self.rate * (std::f64::consts::FRAC_PI_2 * share).sin())).cross(offset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cantilever_rests_at_its_root_and_has_a_free_end() {
        let mode_at = |x: f64| mode(FIRST_MODE * x) / mode(FIRST_MODE);
        assert_eq!(mode_at(0.0), 0.0);
        assert!((mode_at(0.5) - 0.339_523).abs() < 1e-6, "the tabled value of the first mode at half the length");
        let step = 1e-3;
        let bending = (mode_at(1.0) - 2.0 * mode_at(1.0 - step) + mode_at(1.0 - 2.0 * step)) / (step * step);
        assert!(bending.abs() < 0.02, "no moment at the free end, found {bending}");
    }

    #[test]
    fn a_twist_turns_about_its_axis() {
        let twist = Twist { axis: [0.0, 1.0, 0.0].into(), root: [0.0, 0.0, 0.0].into(), length: 6.0, rate: 105.0 };
        let v = twist.velocity(DVec3::new(0.5, 6.0, 0.25));
        assert!((v - DVec3::new(0.25, 0.0, -0.5) * 105.0).length() < 1e-12);
        assert_eq!(twist.velocity(DVec3::new(0.5, -1.0, 0.25)), DVec3::ZERO);
    }
}
