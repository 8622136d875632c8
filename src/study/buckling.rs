//! Load at which a strut buckles: the tangent stiffness of the discrete forces along the scene's own load path,
//! without flaws. The equilibrium is stable while the tangent is positive definite, so the critical load is the
//! first at which L D L^T shows a negative pivot; it is bisected between load steps, always on the straight path.

mod band;
mod path;
mod tangent;

pub use band::{Band, Factors};
pub use path::{Path, Unknown};
pub use tangent::Pattern;

use crate::output::{csv, durable};
use crate::scene::{Particle, Scene};
use crate::tensor::{Line, Plane, Solid, Space};
use glam::DVec3;
use std::path::Path as FilePath;

/// Bracket of the critical part of the load, relative, at which bisection ends.
const BRACKET: f64 = 1e-4;

/// A scene that stops short of its critical load is followed beyond its end, up to so many times its load.
const BEYOND: f64 = 4.0;

/// What buckles, and when.
#[derive(Debug, Clone)]
pub struct Buckling {
    /// Part of the scene's load.
    pub part: f64,
    /// Largest net force on the particles of one boundary condition.
    pub load: f64,
    /// Load over the section: thickness in the plane, area in space.
    pub stress: f64,
    /// By how much the ends along the longest axis have come nearer.
    pub shortening: f64,
    /// Displacement of each particle, by number, the largest of length one.
    pub mode: Vec<DVec3>,
}

impl Buckling {
    pub fn text(&self) -> String {
        format!(
            "critical part of the load {:.6}\nload {:.6e}, over the section {:.6e}, shortening {:.6e}\n",
            self.part, self.load, self.stress, self.shortening
        )
    }
}

/// # Errors
/// One sentence, where the scene has no load steps, does not buckle within its load, or is not held.
pub fn find(scene: &Scene) -> Result<Buckling, String> {
    match scene.dimension() {
        1 => find_in::<Line<f64>>(scene),
        2 => find_in::<Plane<f64>>(scene),
        _ => find_in::<Solid<f64>>(scene),
    }
    .map_err(|reason| format!("{}: {reason}", scene.label()))
}

/// The axis along which a scene is longest.
pub fn longest_axis(scene: &Scene) -> usize {
    let (low, high) = scene.extent();
    let length = (high - low).to_array();
    (0..scene.dimension()).max_by(|&a, &b| length[a].total_cmp(&length[b])).unwrap_or(0)
}

fn find_in<S: Space<Real = f64>>(scene: &Scene) -> Result<Buckling, String> {
    let steps = scene.file.quasi_static.as_ref().ok_or("buckling is sought along load steps: the scene needs [quasi_static]")?;
    if scene.method.contact.any() {
        return Err("the tangent is that of the bonds alone: buckling is sought without contact".into());
    }
    if scene.method.plastic() {
        return Err("the tangent is that of elastic bodies: buckling is sought without a law that yields".into());
    }
    let axis = longest_axis(scene);
    let mut path = Path::<S>::new(scene, axis);
    if path.go(0.0)?.negative() > 0 {
        return Err("the unloaded scene is not stable".into());
    }
    let part = bisect(&mut path, steps.load_steps)?;
    let factors = path.go(part)?;
    Ok(report(scene, &path, axis, part, &factors))
}

/// The first part of the load with a negative pivot, within [`BRACKET`]; leaves the path just before it.
fn bisect<S: Space<Real = f64>>(path: &mut Path<S>, load_steps: u32) -> Result<f64, String> {
    let (mut low, mut step) = (0.0, 1.0 / f64::from(load_steps));
    let mut kept = path.state.columns.displacement.clone();
    let mut bracketed = false;
    while !bracketed || step > BRACKET * low {
        if low >= BEYOND {
            return Err(format!("the scene does not buckle within {BEYOND} times its load"));
        }
        step *= if bracketed { 0.5 } else { 1.0 };
        if path.go(low + step)?.negative() > 0 {
            bracketed = true;
            path.state.columns.displacement.clone_from(&kept);
        } else {
            low += step;
            kept.clone_from(&path.state.columns.displacement);
        }
    }
    Ok(low + step)
}

fn report<S: Space<Real = f64>>(scene: &Scene, path: &Path<S>, axis: usize, part: f64, factors: &Factors) -> Buckling {
    let load = load(scene, path);
    let (low, high) = scene.extent();
    let spacing = scene.bodies[0].spacing;
    let section: f64 = (0..scene.dimension()).filter(|&k| k != axis).map(|k| (high - low)[k] + spacing).product();
    let particles = &path.state.columns;
    let end = |at: f64| {
        let rows = (0..scene.particles.len()).filter(|&a| (particles.reference_position[a][axis] - at).abs() < 0.5 * spacing);
        let moved: Vec<f64> = rows.map(|a| particles.displacement[a][axis]).collect();
        moved.iter().sum::<f64>() / moved.len() as f64
    };
    let shortening = end(low[axis]) - end(high[axis]);
    Buckling { part, load, stress: load / section, shortening, mode: mode(path, factors) }
}

/// Largest net inner force on the particles of one boundary condition.
fn load<S: Space<Real = f64>>(scene: &Scene, path: &Path<S>) -> f64 {
    let state = &path.state;
    let net = |number: u32| {
        let own = (0..scene.particles.len()).filter(|&a| state.columns.constraint.get(a) == Some(&number));
        let force = |a: usize| DVec3::from_array(S::vec_to(state.columns.acceleration[a])) * state.mass(a);
        own.map(force).sum::<DVec3>().length()
    };
    (1..=scene.constraints.len() as u32).map(net).fold(0.0, f64::max)
}

/// Inverse iteration: the tangent is all but singular, and its smallest eigenvalue is the one that changed sign.
fn mode<S: Space<Real = f64>>(path: &Path<S>, factors: &Factors) -> Vec<DVec3> {
    let mut x: Vec<f64> = (0..path.unknowns.len()).map(|k| 1.0 + (1.7 * k as f64).sin()).collect();
    for _ in 0..10 {
        x = factors.solve(x);
        let size = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        x.iter_mut().for_each(|x| *x /= size);
    }
    let mut moved = vec![DVec3::ZERO; path.state.columns.number.len()];
    for (unknown, x) in path.unknowns.iter().zip(x) {
        moved[path.state.columns.number[unknown.particle] as usize][unknown.axis] = x;
    }
    let largest = moved.iter().map(|v| v.length()).fold(0.0, f64::max);
    moved.into_iter().map(|v| v / largest).collect()
}

/// Reference positions and the mode, a row for each particle.
pub fn write_mode(scene: &Scene, found: &Buckling, path: &FilePath) -> Result<(), String> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|e| format!("cannot write {}: {e}", folder.display()))?;
    }
    let header = ["number", "x", "y", "z", "mode_x", "mode_y", "mode_z"].map(String::from);
    let row = |(number, (particle, moved)): (usize, (&Particle, &DVec3))| {
        let (x, v) = (particle.position, moved);
        vec![number as f64, x.x, x.y, x.z, v.x, v.y, v.z]
    };
    let text = csv::text(&header, scene.particles.iter().zip(&found.mode).enumerate().map(row))?;
    durable::put(path, &[text.as_bytes()])
}
