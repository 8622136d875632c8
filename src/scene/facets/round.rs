//! Facets of circles, spheres, cylinders and tubes.

use super::Facet;
use crate::scene::packing::sectors;
use crate::scene::shape::Coordinates;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// How many facets fit around a circle; three at least, or the normals would not add up to zero.
fn count_around(radius: f64, spacing: f64) -> usize {
    (TAU * radius / spacing).round().max(3.0) as usize
}

/// Cosine and sine of angles at equal steps, the first `shift` steps from 0.
fn directions(count: usize, shift: f64) -> impl Iterator<Item = (f64, f64)> {
    (0..count).map(move |k| {
        let (sine, cosine) = (TAU * (k as f64 + shift) / count as f64).sin_cos();
        (cosine, sine)
    })
}

/// A circle in the plane; its normals point away from the centre where `sign` is 1, towards it where -1. The first
/// facet lies towards +x.
pub(super) fn circle(center: &Coordinates, radius: f64, sign: f64, spacing: f64) -> Vec<Facet> {
    let center = center.plane().extend(0.0);
    let count = count_around(radius, spacing);
    let area = TAU * radius / count as f64;
    let facet = |(x, y)| {
        let away = DVec3::new(x, y, 0.0);
        Facet { position: center + radius * away, normal: sign * away, area }
    };
    directions(count, 0.0).map(facet).collect()
}

/// Circles of latitude about z, equally far apart, with one facet on each pole: what another body touches first.
/// Each circle shares its zone of the sphere, to halfway the next, among its facets.
pub(super) fn sphere(center: DVec3, radius: f64, spacing: f64) -> Vec<Facet> {
    let zones = (PI * radius / spacing).round().max(2.0) as usize;
    let step = PI / zones as f64;
    let facet = |normal: DVec3, area| Facet { position: center + radius * normal, normal, area };
    // 1 - cos(step/2), without the digits that the difference would lose.
    let cap = TAU * radius * radius * 2.0 * (step / 4.0).sin().powi(2);
    let mut list = vec![facet(DVec3::Z, cap)];
    for zone in 1..zones {
        let (across, height) = (zone as f64 * step).sin_cos();
        let count = count_around(radius * across, spacing);
        let area = TAU * radius * radius * 2.0 * across * (step / 2.0).sin() / count as f64;
        let shift = if zone % 2 == 0 { 0.0 } else { 0.5 };
        list.extend(directions(count, shift).map(|(x, y)| facet(DVec3::new(across * x, across * y, height), area)));
    }
    list.push(facet(-DVec3::Z, cap));
    list
}

/// A cylinder, or a tube where `inner` is above 0.
pub(super) struct Round {
    pub center: DVec3,
    /// Of any length.
    pub axis: DVec3,
    pub inner: f64,
    pub outer: f64,
    pub length: f64,
}

impl Round {
    /// Mantle, bore, then both ends. The circles of a mantle stand where the layers of rings packing do, the facets of
    /// an end above the particles of its bands.
    pub fn facets(&self, spacing: f64) -> Vec<Facet> {
        let mut list = self.mantle(self.outer, 1.0, spacing);
        if self.inner > 0.0 {
            list.extend(self.mantle(self.inner, -1.0, spacing));
        }
        let axis = self.axis.normalize();
        let (across, up) = axis.any_orthonormal_pair();
        let sectors = sectors(self.inner, self.outer, spacing);
        for normal in [-axis, axis] {
            let middle = self.center + self.length / 2.0 * normal;
            list.extend(sectors.iter().map(|&(x, y, area)| Facet { position: middle + x * across + y * up, normal, area }));
        }
        list
    }

    fn mantle(&self, radius: f64, sign: f64, spacing: f64) -> Vec<Facet> {
        let axis = self.axis.normalize();
        let (across, up) = axis.any_orthonormal_pair();
        let count = count_around(radius, spacing);
        let layers = (self.length / spacing).round().max(1.0);
        let area = TAU * radius / count as f64 * self.length / layers;
        let layer = |index: usize| {
            let middle = self.center + ((index as f64 + 0.5) / layers - 0.5) * self.length * axis;
            directions(count, 0.0).map(move |(x, y)| {
                let away = x * across + y * up;
                Facet { position: middle + radius * away, normal: sign * away, area }
            })
        };
        (0..layers as usize).flat_map(layer).collect()
    }
}
