//! What Monaghan's viscosity takes from a plane wave.
//!
//! It acts on approaching pairs alone, so it is not linear however small the wave: max(0, s) = s/2 + |s|/2 of a relative
//! speed s that is a sine of place. The second part has the even harmonics of the wave alone; what is left in the wave
//! itself is half of a viscosity that acts on all pairs,
//!
//! b = (alpha c h/2) sum V |W'(R)| (1 - cos(k.o)) (x.xi)^2/(r (r^2 + softening h^2)), x = F o, r = |x|,
//!
//! for a motion xi of length one, and its exponents solve lambda^2 + b lambda = lambda_0^2 with those of the undamped
//! lattice, +-lambda_0. Of first order in alpha where the harmonics act back (waves of three spacings, whose second
//! harmonic is the wave itself), and where xi is no eigenvector of the damping: runs agree to some percent at alpha = 1
//! but for waves near critical damping, whose exponents nearly meet. The quadratic term of beta is none of a small wave.

use super::lattice::pairs;
use super::{ArtificialStress, Damage, Lattice, Mode};
use glam::{DMat3, DVec3};

/// Monaghan's viscosity on a lattice.
#[derive(Debug, Clone)]
pub struct Viscous {
    pairs: Vec<Pair>,
}

/// Two opposite neighbours.
#[derive(Debug, Clone, Copy)]
struct Pair {
    offset: DVec3,
    /// x times the root of its weight.
    arm: DVec3,
}

impl Viscous {
    /// `strength` is alpha times c; `deformation` that of the lattice since the configuration in which kernels are.
    pub fn new(lattice: &Lattice, deformation: DMat3, damage: &Damage, strength: f64, softening: f64) -> Self {
        let h = lattice.smoothing_length;
        let pair = |pair: &super::Pair| {
            let x = deformation * pair.offset;
            let slope = pair.gradient.length() * damage.factor(pair.offset.into(), lattice.spacing);
            let weight = 0.5 * strength * h * slope / (x.length() * (x.length_squared() + softening * h * h));
            Pair { offset: pair.offset, arm: x * weight.sqrt() }
        };
        Self { pairs: pairs(lattice, ArtificialStress::None).iter().map(pair).collect() }
    }

    /// b, 1/time, of a motion along a unit vector.
    pub fn rate(&self, k: [f64; 3], direction: DVec3) -> f64 {
        let k = DVec3::from(k);
        self.pairs.iter().map(|pair| (1.0 - k.dot(pair.offset).cos()) * pair.arm.dot(direction).powi(2)).sum()
    }

    /// A motion of the undamped lattice with damping; its growth rate is below zero where it fades.
    pub fn damped(&self, k: [f64; 3], mode: Mode) -> Mode {
        let (re, im) = (DVec3::from(mode.polarisation), DVec3::from(mode.quadrature));
        let half = 0.5 * (self.rate(k, re) + self.rate(k, im));
        if mode.rate > 0.0 && mode.frequency > 0.0 {
            return Mode { rate: mode.rate - half, ..mode };
        }
        let square = half * half + mode.rate * mode.rate - mode.frequency * mode.frequency;
        match square >= 0.0 {
            true => Mode { rate: square.sqrt() - half, frequency: 0.0, ..mode },
            false => Mode { rate: -half, frequency: (-square).sqrt(), ..mode },
        }
    }
}
