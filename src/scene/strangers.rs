//! Bodies with no law between them, and bodies that overlap at the start: both pass through each other in silence.

use super::file::{ContactTable, File};
use super::refuse::Refuse;
use super::shape::Shape;
use super::{Particle, SceneBody, copies, words};
use crate::rows::{ContactPair, FacetPair};
use glam::DVec3;
use std::collections::BTreeSet;

/// How deep in another body's shape, over the spacing, a particle may lie at the start: a ragged surface touches no deeper.
const DEEPEST: f64 = 0.25;

impl ContactTable {
    /// Whether the table says that nothing acts between its bodies: by `none`, or by kernel sums of weight 0 and no law.
    pub fn is_none(&self) -> bool {
        self.none || (self.kernel == Some(0.0) && !self.touches() && self.gap.is_none())
    }
}

/// The tables of what acts between bodies a and b.
pub(super) struct Laws<'a> {
    pub coupling: &'a [Vec<f64>],
    pub contacts: &'a [Vec<ContactPair<f64>>],
    pub gaps: &'a [Vec<FacetPair<f64>>],
}

impl Laws<'_> {
    fn act(&self, a: usize, b: usize) -> bool {
        self.coupling[a][b] > 0.0 || self.contacts[a][b].range > 0.0 || self.gaps[a][b].stiffness > 0.0
    }
}

/// Pairs of bodies, the lower index first, of which the scene says that nothing acts between them.
pub(super) fn meant_apart(
    file: &File,
    bodies: &[SceneBody],
    laws: &Laws,
    refuse: &Refuse,
) -> Result<BTreeSet<(usize, usize)>, String> {
    let mut apart = BTreeSet::new();
    for (k, contact) in file.contact.iter().enumerate().filter(|(_, contact)| contact.is_none()) {
        for (a, b) in copies::pairs(bodies, &contact.between) {
            refuse.unless(!laws.act(a, b), &["contact", &k.to_string()], || {
                format!("another [[contact]] has a law for the bodies `{}` and `{}`", bodies[a].name, bodies[b].name)
            })?;
            apart.insert((a.min(b), a.max(b)));
        }
    }
    Ok(apart)
}

/// Whether bodies a and b have no law between them and the scene does not say that this is meant. Empty where there are none.
pub(super) fn strangers(bodies: usize, laws: &Laws, apart: &BTreeSet<(usize, usize)>) -> Vec<Vec<bool>> {
    let strange = |a: usize, b: usize| a != b && !laws.act(a, b) && !apart.contains(&(a.min(b), a.max(b)));
    let table: Vec<Vec<bool>> = (0..bodies).map(|a| (0..bodies).map(|b| strange(a, b)).collect()).collect();
    if table.iter().flatten().any(|strange| *strange) { table } else { Vec::new() }
}

/// Refuses bodies of which a particle lies inside another's shape, but for those that are meant to have nothing between them.
pub(super) fn no_overlap(
    file: &File,
    bodies: &[SceneBody],
    particles: &[Particle],
    apart: &BTreeSet<(usize, usize)>,
    refuse: &Refuse,
) -> Result<(), String> {
    if bodies.len() < 2 {
        return Ok(());
    }
    let mut own = vec![Vec::new(); bodies.len()];
    particles.iter().for_each(|particle| own[particle.body as usize].push(particle.position));
    let boxes: Vec<(DVec3, DVec3)> = file.body.iter().map(|body| body.shape.bounds(file.dimension)).collect();
    for (a, b) in near_pairs(&boxes) {
        if apart.contains(&(a, b)) {
            continue;
        }
        let least = DEEPEST * bodies[a].spacing.min(bodies[b].spacing);
        let inside = |of: usize, other: usize| deepest(&own[of], &file.body[other].shape, boxes[other], file.dimension);
        let (depth, place, of, other) = match (inside(a, b), inside(b, a)) {
            ((first, place), (second, _)) if first >= second => (first, place, a, b),
            (_, (depth, place)) => (depth, place, b, a),
        };
        refuse.unless(depth <= least, &["body", &b.to_string()], || {
            format!(
                "the bodies `{}` and `{}` overlap at the start: a particle of `{}` at {} lies {} deep in `{}`; move them \
                 apart, cut one out of the other's shape, or name a [[contact]] with `none = true` between them if nothing shall \
                 act there",
                bodies[a].name,
                bodies[b].name,
                bodies[of].name,
                words::place(place, file.dimension),
                words::rounded(depth, 4),
                bodies[other].name,
            )
        })?;
    }
    Ok(())
}

/// Depth and place of the point that lies deepest in the shape; 0 where none does.
fn deepest(points: &[DVec3], shape: &Shape, (min, max): (DVec3, DVec3), dimension: usize) -> (f64, DVec3) {
    let near = points.iter().filter(|point| point.cmpge(min).all() && point.cmple(max).all());
    let depths = near.map(|&point| (-shape.distance(point, dimension), point));
    depths.fold((0.0, DVec3::ZERO), |deepest, found| if found.0 > deepest.0 { found } else { deepest })
}

/// Pairs of boxes that share a point, the lower index first, in ascending order. Boxes are swept along x, so that a row of many
/// costs little more than their number.
pub fn near_pairs(boxes: &[(DVec3, DVec3)]) -> Vec<(usize, usize)> {
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&a, &b| boxes[a].0.x.total_cmp(&boxes[b].0.x));
    let mut pairs = Vec::new();
    for (place, &a) in order.iter().enumerate() {
        let later = order[place + 1..].iter().take_while(|&&b| boxes[b].0.x <= boxes[a].1.x);
        let meet = |b: &&usize| boxes[**b].0.cmple(boxes[a].1).all() && boxes[a].0.cmple(boxes[**b].1).all();
        pairs.extend(later.filter(meet).map(|&b| (a.min(b), a.max(b))));
    }
    pairs.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_share_a_point_are_found_once() {
        let boxed = |x: f64, y: f64| (DVec3::new(x, y, 0.0), DVec3::new(x + 1.0, y + 1.0, 0.0));
        let boxes = [boxed(5.0, 0.0), boxed(0.0, 0.0), boxed(0.5, 0.5), boxed(0.5, 3.0), boxed(1.5, 1.5)];
        assert_eq!(near_pairs(&boxes), [(1, 2), (2, 4)]);
    }
}
