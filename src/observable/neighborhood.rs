//! How particles lie to each other: pieces, least distance, disorder.

use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;
use glam::DVec3;
use std::collections::HashMap;

/// Visits every pair of the selection nearer than `reach`, by a hash grid.
fn near_pairs(points: &[DVec3], reach: f64, mut visit: impl FnMut(usize, usize, f64)) {
    let key = |p: DVec3| (p / reach).floor().as_i64vec3().to_array();
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for (i, &p) in points.iter().enumerate() {
        let [x, y, z] = key(p);
        for dz in -1..=1 {
            for dy in -1..=1 {
                for dx in -1..=1 {
                    for &j in cells.get(&[x + dx, y + dy, z + dz]).into_iter().flatten() {
                        let distance = p.distance(points[j]);
                        if distance < reach {
                            visit(i, j, distance);
                        }
                    }
                }
            }
        }
        cells.entry([x, y, z]).or_default().push(i);
    }
}

fn points(moment: &Moment, observer: &Observer) -> Vec<DVec3> {
    observer.particles.iter().map(|&i| DVec3::from_array(moment.position(i))).collect()
}

/// Spacing of the first selected particle's body.
fn spacing(moment: &Moment, observer: &Observer) -> f64 {
    let scene = moment.scene;
    scene.bodies[scene.particles[observer.particles[0]].body as usize].spacing
}

fn pieces(moment: &Moment, observer: &Observer) -> f64 {
    let points = points(moment, observer);
    let reach = observer.typed.distance.unwrap_or(1.5) * spacing(moment, observer);
    let mut parent: Vec<usize> = (0..points.len()).collect();
    fn root(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    near_pairs(&points, reach, |i, j, _| {
        let (a, b) = (root(&mut parent, i), root(&mut parent, j));
        parent[a.max(b)] = a.min(b);
    });
    let mut sizes: HashMap<usize, usize> = HashMap::new();
    for i in 0..points.len() {
        *sizes.entry(root(&mut parent, i)).or_default() += 1;
    }
    sizes.values().filter(|&&size| size >= SMALLEST_PIECE).count() as f64
}

/// Fewer particles than this are a splinter, not a piece.
const SMALLEST_PIECE: usize = 3;

fn least_distance(moment: &Moment, observer: &Observer) -> f64 {
    let (points, spacing) = (points(moment, observer), spacing(moment, observer));
    let mut least = f64::INFINITY;
    near_pairs(&points, 2.0 * spacing, |_, _, distance| least = least.min(distance));
    least / spacing
}

/// Spread of the distances to the nearest particle: 0 on a lattice, about 0.2 in a gas.
fn disorder(moment: &Moment, observer: &Observer) -> f64 {
    let (points, spacing) = (points(moment, observer), spacing(moment, observer));
    let mut nearest = vec![f64::INFINITY; points.len()];
    near_pairs(&points, 2.0 * spacing, |i, j, distance| {
        nearest[i] = nearest[i].min(distance);
        nearest[j] = nearest[j].min(distance);
    });
    let known: Vec<f64> = nearest.into_iter().filter(|d| d.is_finite()).map(|d| d / spacing).collect();
    let mean = known.iter().sum::<f64>() / known.len() as f64;
    (known.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / known.len() as f64).sqrt()
}

pub const PIECES: ObservableKind = ObservableKind {
    word: "pieces",
    about: "connected groups of at least 3 particles, linked where nearer than `distance` spacings (1.5)",
    needs: &[],
    fields: &[Field::Displacement],
    value: Value::Series(pieces),
};

pub const DISTANCE: ObservableKind = ObservableKind {
    word: "least_distance",
    about: "least distance of two particles, in spacings",
    needs: &[],
    fields: &[Field::Displacement],
    value: Value::Series(least_distance),
};

pub const DISORDER: ObservableKind = ObservableKind {
    word: "disorder",
    about: "standard deviation of the distance to the nearest particle, in spacings",
    needs: &[],
    fields: &[Field::Displacement],
    value: Value::Series(disorder),
};
