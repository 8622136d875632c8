//! Snapshots that the tests of both painters share.

use super::picture::View;
use super::snapshot::{Column, Snapshot};

fn snapshot(dimension: usize, spacing: f64, positions: Vec<[f64; 3]>, name: &str, value: fn(&[f64; 3]) -> f64) -> Snapshot {
    let values = positions.iter().map(value).collect();
    let column = |name: &str, unit: &str, components, values| Column { name: name.into(), unit: unit.into(), components, values };
    let rest = vec![0.0; 3 * positions.len()];
    let columns = vec![column(name, "Pa", 1, values), column("velocity", "m/s", 3, rest)];
    Snapshot { time: 1.25e-3, step: 4200, dimension, spacing, positions, columns }
}

/// A ring of about 1000 particles under a pressure of both signs.
pub fn ring() -> Snapshot {
    let dx = 0.0016;
    let lattice = (-25..=25).flat_map(|i| (-25..=25).map(move |j| [i as f64 * dx, j as f64 * dx, 0.0]));
    let inside = |p: &[f64; 3]| (0.03..0.04).contains(&p[0].hypot(p[1]));
    snapshot(2, dx, lattice.filter(inside).collect(), "pressure", |p| 2.4e7 * (p[0] / 0.04) + 4e6)
}

/// A cube of `n`³ particles with a corner hanging out, coloured by height and distance.
pub fn cube(n: usize) -> Snapshot {
    let dx = 1.0 / n as f64;
    let at = |k: usize| (k as f64 + 0.5) * dx;
    let lattice = (0..n * n * n).map(|k| [at(k % n), at(k / n % n), 1.2 * at(k / n / n)]);
    snapshot(3, dx, lattice.collect(), "von_mises", |p| 1e5 * (p[0] * 3.0).sin().abs() + 2e5 * p[2])
}

pub fn bar() -> Snapshot {
    let positions = (0..120).map(|k| [k as f64 * 0.01, 0.0, 0.0]).collect();
    snapshot(1, 0.01, positions, "pressure", |p| 3e9 / (1.0 + (80.0 * (p[0] - 0.7)).exp()))
}

pub fn view(field: &str) -> View {
    View { field: field.into(), caption: "rubber_rings".into(), ..View::default() }
}
