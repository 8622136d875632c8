//! The lattice: its neighbours with their kernel values, and the waves that fit it.

use super::{ArtificialStress, outer, within};
use crate::smoothing::Smoothing;
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// Square lattice of particles in its stressed state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// 1 (uniaxial strain), 2 (plane strain) or 3.
    pub dimension: usize,
    /// Distance dx of nearest neighbours in the stressed state.
    pub spacing: f64,
    /// Kernel.
    pub smoothing: Smoothing,
    /// h; pairs at less than 2 h meet.
    pub smoothing_length: f64,
}

/// A pair of neighbours at +offset and -offset, its sums' terms times 2 V.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub offset: DVec3,
    /// W.
    pub value: f64,
    pub gradient: DVec3,
    pub hessian: DMat3,
    /// f^n, and the Hessian of the artificial stress's pair potential.
    pub repulsion: f64,
    pub repulsion_hessian: DMat3,
}

/// One of each two opposite neighbours. A pair at the very end of the support (2 h) does not count.
pub(super) fn pairs(lattice: &Lattice, artificial_stress: ArtificialStress) -> Vec<Pair> {
    let &Lattice { dimension, spacing, smoothing, smoothing_length: h } = lattice;
    let reach = (2.0 * h / spacing).ceil() as i32;
    let along = |axis: usize| if axis < dimension { -reach..=reach } else { 0..=0 };
    let mut pairs = Vec::new();
    for (i, j, k) in along(0).flat_map(|i| along(1).flat_map(move |j| along(2).map(move |k| (i, j, k)))) {
        let offset = DVec3::new(i as f64, j as f64, k as f64) * spacing;
        let r = offset.length();
        if (i, j, k) <= (0, 0, 0) || r >= (2.0 - 1e-9) * h {
            continue;
        }
        let weight = 2.0 * spacing.powi(dimension as i32);
        let normal = offset / r;
        let radial = outer(normal, normal);
        let slope = smoothing.derivative(r, h, dimension);
        let transverse = within(DMat3::IDENTITY, dimension) - radial;
        let hessian = radial * second_derivative(lattice, r) + transverse * (slope / r);
        let (repulsion, stiffening) = artificial_stress.shape().map_or((0.0, 0.0), |(exponent, at)| {
            let whole = smoothing.value(at, h, dimension);
            let f = smoothing.value(r, h, dimension) / whole;
            (f.powf(exponent), exponent * f.powf(exponent - 1.0) * slope * slope / whole)
        });
        pairs.push(Pair {
            offset,
            value: smoothing.value(r, h, dimension) * weight,
            gradient: normal * (-slope * weight),
            hessian: hessian * weight,
            repulsion,
            repulsion_hessian: (hessian * repulsion + radial * stiffening) * weight,
        });
    }
    pairs
}

/// W''(r), from the slopes on either side of r: the mean of two one-sided differences of second order, which a knot
/// of the kernel at r leaves exact, or the inner one alone at the end of the support.
pub(in crate::study) fn second_derivative(lattice: &Lattice, r: f64) -> f64 {
    let h = lattice.smoothing_length;
    let slope = |r: f64| lattice.smoothing.derivative(r, h, lattice.dimension);
    let one_sided = |step: f64| (4.0 * slope(r + step) - 3.0 * slope(r) - slope(r + 2.0 * step)) / (2.0 * step);
    let step = 1e-5 * h;
    if r + 2.0 * step < 2.0 * h { 0.5 * (one_sided(step) + one_sided(-step)) } else { one_sided(-step) }
}

/// Waves that fit a periodic box of the given number of particles along each axis (1 along an axis that is not
/// there): k = 2 pi n/(N dx) over the Brillouin zone, without k = 0 and with one of k and -k, which are equal.
pub fn periodic_wave_vectors(cells: [usize; 3], spacing: f64) -> Vec<[f64; 3]> {
    let [nx, ny, nz] = cells.map(|n| n as i64);
    let zone = |n: i64| -((n - 1) / 2)..=n / 2;
    let opposite = |m: i64, n: i64| if 2 * m == n { m } else { -m };
    let mut waves = Vec::new();
    for (x, y, z) in zone(nx).flat_map(|x| zone(ny).flat_map(move |y| zone(nz).map(move |z| (x, y, z)))) {
        if (x, y, z) != (0, 0, 0) && (x, y, z) >= (opposite(x, nx), opposite(y, ny), opposite(z, nz)) {
            waves.push([(x, nx), (y, ny), (z, nz)].map(|(m, n)| 2.0 * PI * m as f64 / (n as f64 * spacing)));
        }
    }
    waves
}

/// Standing waves of a block whose border is held, with the given number of free particles along each axis (0 along
/// an axis that is not there): k = pi n/((free + 1) dx), n = 1 .. free. An estimate, as the waves of different
/// directions meet at the border; it takes the stress to have the axes of the lattice.
pub fn fixed_wave_vectors(free: [usize; 3], spacing: f64) -> Vec<[f64; 3]> {
    let along = |n: usize| -> Vec<f64> {
        let numbers = if n == 0 { 0..=0 } else { 1..=n };
        numbers.map(|m| PI * m as f64 / ((n + 1) as f64 * spacing)).collect()
    };
    let [x, y, z] = free.map(along);
    x.iter()
        .flat_map(|&x| {
            y.iter().flat_map({
                let z = &z;
                move |&y| z.iter().map(move |&z| [x, y, z])
            })
        })
        .collect()
}
