//! Which particle carries a facet: the one nearest to half a spacing beneath it.

use super::Facet;
use glam::{DVec3, I64Vec3};
use std::collections::HashMap;

/// Rings of cells that are searched before all particles are.
const RINGS: i64 = 4;

/// For each facet the index in `particles` (m) of the one nearest to half a `spacing` (m) beneath the facet; of those
/// equally near the first.
///
/// # Panics
/// If there are facets, but no particles.
pub fn owners(facets: &[Facet], particles: &[DVec3], spacing: f64) -> Vec<u32> {
    let grid = Grid::new(particles, spacing);
    facets.iter().map(|facet| grid.nearest(facet.position - spacing / 2.0 * facet.normal)).collect()
}

/// Particles by the cell that they lie in; cells are as wide as the spacing.
struct Grid<'a> {
    particles: &'a [DVec3],
    side: f64,
    cells: HashMap<I64Vec3, Vec<u32>>,
}

impl<'a> Grid<'a> {
    fn new(particles: &'a [DVec3], side: f64) -> Self {
        let mut cells: HashMap<I64Vec3, Vec<u32>> = HashMap::new();
        for (index, &position) in particles.iter().enumerate() {
            cells.entry(cell(position, side)).or_default().push(index as u32);
        }
        Self { particles, side, cells }
    }

    fn nearest(&self, point: DVec3) -> u32 {
        let middle = cell(point, self.side);
        let mut near = Vec::new();
        for ring in 0..=RINGS {
            near.extend(shell(ring).filter_map(|offset| self.cells.get(&(middle + offset))).flatten().copied());
            // All within `ring` sides of the point lie in the cells searched so far.
            if let Some(best) = self.best(point, near.iter().copied())
                && self.particles[best as usize].distance(point) <= ring as f64 * self.side
            {
                return best;
            }
        }
        self.best(point, 0..self.particles.len() as u32).expect("a body has particles")
    }

    fn best(&self, point: DVec3, among: impl Iterator<Item = u32>) -> Option<u32> {
        let distance = |index: u32| self.particles[index as usize].distance_squared(point);
        among.min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)))
    }
}

fn cell(position: DVec3, side: f64) -> I64Vec3 {
    (position / side).floor().as_i64vec3()
}

/// Offsets of the cells that are `ring` cells away along some axis and no further along the others.
fn shell(ring: i64) -> impl Iterator<Item = I64Vec3> {
    let range = move || -ring..=ring;
    let all = range().flat_map(move |z| range().flat_map(move |y| range().map(move |x| I64Vec3::new(x, y, z))));
    all.filter(move |offset| offset.abs().max_element() == ring)
}
