//! Stability of uniform lattices in theory and in runs, and the longest steps of the integrators.
//!
//! [`Setting`] takes a scene's first body for an infinite square lattice in the state that the scene gives it: an
//! Eulerian body's `relative_volume` and `deviatoric_stress`, a Total Lagrangian one's `[study.stability]`. [`growth`]
//! finds its fastest wave by von Neumann's analysis of the discrete equations ([`super::von_neumann`]), [`simulate`]
//! the growth rate or frequency of one wave from a run, and [`limits`] the longest time step of each integrator, from
//! the largest eigenvalue of the discrete equations and from runs.

mod halo;
mod limits;
mod points;
mod report;
mod setting;
mod simulate;
mod study;
mod zone;

pub use limits::{Limit, Secular, limits, secular};
pub use points::chosen;
pub use setting::Setting;
pub use simulate::{Measured, simulate};
pub use study::{Request, run};
pub use zone::{Sample, Zone};

use super::von_neumann::Mode;

/// What theory says of a setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// The fastest growing wave, and how it moves.
    pub wave: [f64; 3],
    pub mode: Mode,
    /// Largest angular frequency of all waves without damping, 1/time.
    pub largest_frequency: f64,
    /// 2 over it: the longest step of leapfrog.
    pub leapfrog_step: f64,
}

/// The fastest wave and the largest frequency among those of a periodic box of `cells` particles a side, two at least.
pub fn growth(setting: &Setting, cells: usize) -> Growth {
    let vectors = setting.wave_vectors(cells);
    let (wave, mode) = setting.fastest(&vectors).expect("a box of two particles has a wave");
    let largest_frequency = setting.waves().largest_frequency(&vectors);
    Growth { wave, mode, largest_frequency, leapfrog_step: 2.0 / largest_frequency }
}

#[cfg(test)]
mod tests;
