//! What plane waves on a lattice do, from A(k) alone.

use crate::study::eigen::{Eigenpair, eigenpairs};
use glam::DMat3;
use rayon::prelude::*;

/// One plane wave's fastest growing motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Growth rate, 1/time; 0 where the wave is stable, less where it is damped.
    pub rate: f64,
    /// Angular frequency; 0 for growth without oscillation.
    pub frequency: f64,
    /// Unit vector of the displacement (real part of the eigenvector).
    pub polarisation: [f64; 3],
    /// Imaginary part of the eigenvector: the part that moves a quarter of a period away. Mostly zero.
    pub quadrature: [f64; 3],
}

/// By falling growth rate, then by rising frequency.
pub fn by_growth(modes: &mut [Mode]) {
    modes.sort_by(|a, b| b.rate.total_cmp(&a.rate).then(a.frequency.total_cmp(&b.frequency)));
}

/// A uniform, infinite lattice of which the discrete equations have been linearised.
pub trait Waves: Sync {
    /// 1, 2 or 3.
    fn dimension(&self) -> usize;

    /// A(k), in 1/time^2: displacements xi exp(i k.X) accelerate as A xi exp(i k.X). Rows and columns beyond the
    /// dimension are zero.
    fn stiffness(&self, k: [f64; 3]) -> DMat3;

    /// Largest Re sqrt(lambda) of A(k), 1/time; zero where the wave is stable.
    fn growth_rate(&self, k: [f64; 3]) -> f64 {
        self.eigenpairs(k).iter().map(|pair| pair.square_root()[0]).fold(0.0, f64::max)
    }

    /// The fastest growing motion of the wave; of stable ones the slowest.
    fn mode(&self, k: [f64; 3]) -> Mode {
        let mut modes = self.modes(k);
        modes.swap_remove(0)
    }

    /// Every motion of the wave, one of each conjugate pair, by falling growth rate and rising frequency.
    fn modes(&self, k: [f64; 3]) -> Vec<Mode> {
        let of = |pair: &Eigenpair| {
            let [rate, frequency] = pair.square_root();
            let (polarisation, quadrature) = (pair.vector.into(), pair.imaginary.into());
            Mode { rate, frequency: frequency.abs(), polarisation, quadrature }
        };
        let mut modes: Vec<Mode> = self.eigenpairs(k).iter().filter(|pair| pair.value[1] >= 0.0).map(of).collect();
        by_growth(&mut modes);
        modes
    }

    /// The wave vector of the largest growth rate, and that rate.
    fn fastest(&self, wave_vectors: &[[f64; 3]]) -> ([f64; 3], f64) {
        wave_vectors.par_iter().map(|&k| (k, self.growth_rate(k))).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(([0.0; 3], 0.0))
    }

    /// Largest |Im sqrt(lambda)|, 1/time: leapfrog is stable for time steps below 2 over it.
    fn largest_frequency(&self, wave_vectors: &[[f64; 3]]) -> f64 {
        let largest = |k: &[f64; 3]| self.eigenpairs(*k).iter().map(|pair| pair.square_root()[1].abs()).fold(0.0, f64::max);
        wave_vectors.par_iter().map(largest).reduce(|| 0.0, f64::max)
    }

    /// Of A(k).
    fn eigenpairs(&self, k: [f64; 3]) -> Vec<Eigenpair> {
        eigenpairs(self.stiffness(k), self.dimension())
    }
}
