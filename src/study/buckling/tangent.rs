//! Tangent stiffness by central differences of the twins' forces.
//!
//! The force on a particle depends on displacements up to two lists away. Unknowns whose forces do not meet are
//! changed at once: they get one colour (Curtis, Powell & Reid 1974), so that the number of evaluations does not
//! grow with the number of particles.

use super::band::Band;
use super::path::{Path, Unknown, difference};
use crate::rows::NEIGHBOR_MASK;
use crate::state::State;
use crate::tensor::Space;

/// Which unknowns act on which forces, and which are changed together.
#[derive(Debug, Default)]
pub struct Pattern {
    /// For each unknown those whose force it changes.
    reached: Vec<Vec<u32>>,
    /// Unknowns of each colour.
    colours: Vec<Vec<u32>>,
    width: usize,
}

impl Pattern {
    pub fn new<S: Space>(state: &State<S>, unknowns: &[Unknown]) -> Self {
        let mut of_particle: Vec<Vec<u32>> = vec![Vec::new(); state.columns.displacement.len()];
        for (k, unknown) in unknowns.iter().enumerate() {
            of_particle[unknown.particle].push(k as u32);
        }
        let reach = |u: &Unknown| -> Vec<u32> {
            second_neighbors(state, u.particle).into_iter().flat_map(|b| of_particle[b].iter().copied()).collect()
        };
        let reached: Vec<Vec<u32>> = unknowns.iter().map(reach).collect();
        let span = |(k, list): (usize, &Vec<u32>)| list.iter().map(|&j| (j as usize).abs_diff(k)).max().unwrap_or(0);
        let width = reached.iter().enumerate().map(span).max().unwrap_or(0);
        let colours = coloured(&reached);
        Self { reached, colours, width }
    }

    pub fn tangent<S: Space<Real = f64>>(&self, path: &mut Path<S>) -> Band {
        let mut band = Band::new(self.reached.len(), self.width);
        let step = difference(path.state.bodies.iter().map(|b| b.smoothing_length).fold(f64::INFINITY, f64::min));
        let kept = path.state.columns.displacement.clone();
        for colour in &self.colours {
            let side = |path: &mut Path<S>, sign: f64| {
                for &k in colour {
                    let unknown = path.unknowns[k as usize];
                    path.state.columns.displacement[unknown.particle][unknown.axis] += sign * step;
                }
                let forces = path.forces();
                path.state.columns.displacement.clone_from(&kept);
                forces
            };
            let (ahead, behind) = (side(path, 1.0), side(path, -1.0));
            for &k in colour {
                for &j in &self.reached[k as usize] {
                    let value = (behind[j as usize] - ahead[j as usize]) / (2.0 * step);
                    // Both triangles are found; their mean is kept.
                    band.add(j as usize, k as usize, if j == k { value } else { 0.5 * value });
                }
            }
        }
        band
    }

    /// Largest difference of the two triangles over the largest entry.
    pub fn asymmetry<S: Space<Real = f64>>(path: &mut Path<S>) -> f64 {
        let count = path.unknowns.len();
        let step = difference(path.state.bodies[0].smoothing_length);
        let kept = path.state.columns.displacement.clone();
        let mut columns = Vec::new();
        for k in 0..count {
            let mut unit = vec![0.0; count];
            unit[k] = step;
            path.add(&unit, 1.0);
            let ahead = path.forces();
            path.add(&unit, -2.0);
            let behind = path.forces();
            path.state.columns.displacement.clone_from(&kept);
            columns.push(behind.iter().zip(&ahead).map(|(b, a)| (b - a) / (2.0 * step)).collect::<Vec<f64>>());
        }
        let pairs = || (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
        let largest = pairs().map(|(i, j)| columns[i][j].abs()).fold(0.0, f64::max);
        pairs().map(|(i, j)| (columns[i][j] - columns[j][i]).abs()).fold(0.0, f64::max) / largest
    }
}

/// Particles whose force depends on where this one is, itself among them.
fn second_neighbors<S: Space>(state: &State<S>, a: usize) -> Vec<usize> {
    let near = |a: usize| state.neighbors_of(a).iter().map(|entry| (entry & NEIGHBOR_MASK) as usize).chain([a]);
    let mut list: Vec<usize> = near(a).flat_map(near).collect();
    list.sort_unstable();
    list.dedup();
    list
}

/// Each unknown gets the first colour that none has whose forces meet its own.
fn coloured(reached: &[Vec<u32>]) -> Vec<Vec<u32>> {
    let mut colours: Vec<Vec<u32>> = Vec::new();
    // For each force the colours that change it already.
    let mut taken: Vec<Vec<u32>> = vec![Vec::new(); reached.len()];
    for (k, forces) in reached.iter().enumerate() {
        let mut used = vec![false; colours.len() + 1];
        forces.iter().flat_map(|&j| &taken[j as usize]).for_each(|&colour| used[colour as usize] = true);
        let colour = used.iter().position(|used| !used).unwrap_or(colours.len());
        if colour == colours.len() {
            colours.push(Vec::new());
        }
        colours[colour].push(k as u32);
        forces.iter().for_each(|&j| taken[j as usize].push(colour as u32));
    }
    colours
}
