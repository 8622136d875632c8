//! Swegle's test as von Neumann's analysis sees it: an infinite lattice of spacing 1 under uniform tension, in units of
//! its spacing dx and its speed of sound c when unstressed.

use super::windows::RANGE;
use crate::smoothing::Smoothing;
use crate::study::von_neumann::{ArtificialStress, Equations, Gradient, Lattice, Medium, Waves as _};
use std::f64::consts::PI;

/// Growth rate in c/dx below which a wave counts as stable: the sums' rounding alone gives some 1e-7.
pub const STABLE: f64 = 1e-5;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// Linear equation of state without shear stress, as Strand runs it.
    Fluid,
    /// Poisson ratio 0.3.
    Elastic,
}

/// Which tensor the repulsive force is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// epsilon |P|/rho^2 in tension (Monaghan 2000).
    Pressure,
    /// epsilon tr(sigma)/rho^2 in tension, as the thesis prints what its code does: three times as much.
    Trace,
    /// Tensile principal stresses (Gray, Monaghan & Swift 2001).
    Principal,
    /// epsilon P/rho^2 whatever its sign: repels in tension, attracts in compression.
    Signed,
    /// -epsilon P/rho^2: attracts in tension, repels in compression.
    Opposed,
}

/// What the dp in f = W(r)/W(dp) means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spacing {
    /// The spacing of the particles at the start.
    Initial,
    /// The mean distance of a particle from its neighbours.
    Mean,
    /// A length in units of dx.
    Given(f64),
}

impl Spacing {
    pub fn word(self) -> String {
        match self {
            Self::Initial => "initial".into(),
            Self::Mean => "mean".into(),
            Self::Given(length) => format!("{length} dx"),
        }
    }
}

/// One lattice, state and repulsive force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    pub dimension: usize,
    /// h/dx.
    pub ratio: f64,
    /// Volume relative to that without stress.
    pub volume: f64,
    pub law: Law,
    pub form: Form,
    /// 0 for none.
    pub epsilon: f64,
    /// n of f^n.
    pub exponent: f64,
    pub spacing: Spacing,
}

impl Case {
    /// Strand's usual case: a fluid at V 1.01, n 4, dp the initial spacing, no repulsive force yet.
    pub fn new(dimension: usize, ratio: f64) -> Self {
        Self {
            dimension,
            ratio,
            volume: 1.01,
            law: Law::Fluid,
            form: Form::Pressure,
            epsilon: 0.0,
            exponent: 4.0,
            spacing: Spacing::Initial,
        }
    }
    pub fn volume(self, volume: f64) -> Self {
        Self { volume, ..self }
    }
    pub fn epsilon(self, epsilon: f64) -> Self {
        Self { epsilon, ..self }
    }
    pub fn spacing(self, spacing: Spacing) -> Self {
        Self { spacing, ..self }
    }
    pub fn form(self, form: Form) -> Self {
        Self { form, ..self }
    }

    /// Distances of a particle's neighbours, those at less than 2 h.
    pub fn distances(&self) -> Vec<f64> {
        let reach = (2.0 * self.ratio).ceil() as i32;
        let along = |axis: usize| if axis < self.dimension { -reach..=reach } else { 0..=0 };
        let mut distances = Vec::new();
        for (i, j, k) in along(0).flat_map(|i| along(1).flat_map(move |j| along(2).map(move |k| (i, j, k)))) {
            let r = f64::from(i * i + j * j + k * k).sqrt();
            if r > 0.0 && r < 2.0 * self.ratio - 1e-9 {
                distances.push(r);
            }
        }
        distances
    }

    /// dp in units of dx.
    pub fn dp(&self) -> f64 {
        match self.spacing {
            Spacing::Initial => 1.0,
            Spacing::Mean => {
                let distances = self.distances();
                distances.iter().sum::<f64>() / distances.len() as f64
            }
            Spacing::Given(length) => length,
        }
    }

    /// f^n of nearest neighbours with this dp, over that with the initial spacing, which is 1.
    pub fn strength(&self) -> f64 {
        let lattice = self.lattice();
        let value = |r: f64| lattice.smoothing.value(r, lattice.smoothing_length, lattice.dimension);
        (value(1.0) / value(self.dp())).powf(self.exponent)
    }

    /// The range of epsilon that scans go through: 0.0001 to 1000 for nearest neighbours.
    pub fn range(&self) -> [f64; 2] {
        RANGE.map(|epsilon| epsilon / self.strength())
    }

    /// dx = 1, rho0 = 1 and the longitudinal speed of sound 1.
    pub fn medium(&self) -> Medium {
        match self.law {
            Law::Fluid => Medium::at_volume(self.volume, 1.0, 1.0, 0.0),
            Law::Elastic => {
                // K + 4 mu/3 = 1 at Poisson ratio 0.3.
                let nu = 0.3;
                Medium::at_volume(self.volume, 1.0, (1.0 + nu) / (3.0 * (1.0 - nu)), (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)))
            }
        }
    }

    pub fn lattice(&self) -> Lattice {
        Lattice { dimension: self.dimension, spacing: 1.0, smoothing: Smoothing::CubicSpline, smoothing_length: self.ratio }
    }

    /// None where W(dp) is zero, so that f is infinite.
    pub fn equations(&self) -> Option<Equations> {
        let (epsilon, exponent, spacing) = (self.epsilon, self.exponent, self.dp());
        if epsilon != 0.0 && spacing >= 2.0 * self.ratio {
            return None;
        }
        let artificial_stress = match self.form {
            _ if epsilon == 0.0 => ArtificialStress::None,
            Form::Pressure => ArtificialStress::Scalar { epsilon, exponent, spacing },
            Form::Trace => ArtificialStress::Scalar { epsilon: 3.0 * epsilon, exponent, spacing },
            Form::Principal => ArtificialStress::Principal { epsilon, exponent, spacing },
            Form::Signed => ArtificialStress::Signed { epsilon, exponent, spacing },
            Form::Opposed => ArtificialStress::Signed { epsilon: -epsilon, exponent, spacing },
        };
        Some(Equations::new(self.lattice(), self.medium(), artificial_stress, Gradient::Plain))
    }

    /// Largest growth rate over the zone in c/dx; infinite where f is.
    pub fn growth(&self) -> f64 {
        self.equations().map_or(f64::INFINITY, |equations| equations.fastest(&zone(self.dimension)).1)
    }

    pub fn is_stable(&self) -> bool {
        self.growth() < STABLE
    }
}

/// Wave vectors over one of the equal parts that the symmetries of the lattice make of the zone, for isotropic stress:
/// 0 <= k_z <= k_y <= k_x <= pi/dx without k = 0. Twice as many along an axis move the ends of windows by 0.5 % and the rates
/// by 2 % in 3D, less in 1D and 2D.
pub fn zone(dimension: usize) -> Vec<[f64; 3]> {
    let steps = [240, 40, 12][dimension - 1];
    let at = |n: usize| PI * n as f64 / steps as f64;
    let below = |n: usize, axis: usize| if axis < dimension { 0..=n } else { 0..=0 };
    (1..=steps).flat_map(|x| below(x, 1).flat_map(move |y| below(y, 2).map(move |z| [at(x), at(y), at(z)]))).collect()
}
