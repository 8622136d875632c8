//! Watches for bodies that pass through each other: those that come close with no law between them, and those whose law gives
//! way. Nothing else says so.

use crate::observable::Moment;
use crate::scene::strangers::near_pairs;
use crate::scene::words;
use crate::scene::{Scene, SceneBody};
use glam::{DVec3, I64Vec3};
use std::collections::{BTreeSet, HashMap};

/// Bodies that lie on one lattice and share a face are exactly one spacing apart; rounding shall not decide whether that is told.
const ROUNDING: f64 = 1e-6;

/// Distance, over the spacing, within which a particle inside another body has at least two of that body's particles for each
/// axis.
const INSIDE: f64 = 1.3;
/// Length of the mean of the directions to them: about 0 in their midst, and still 0.4 where two surfaces are pressed
/// together to a fifth of a spacing.
const MIDST: f64 = 0.2;

/// What was told so far.
#[derive(Debug, Default)]
pub struct Meetings {
    told: BTreeSet<[String; 2]>,
}

impl Meetings {
    /// For a checkpoint.
    pub fn save(&self) -> Vec<[String; 2]> {
        self.told.iter().cloned().collect()
    }

    /// Goes on from what was told up to a checkpoint.
    pub fn load(told: &[[String; 2]]) -> Self {
        Self { told: told.iter().cloned().collect() }
    }

    /// Whether a scene has bodies that could meet so.
    pub fn possible(scene: &Scene) -> bool {
        !scene.strangers.is_empty()
    }

    /// One sentence for each pair of names whose bodies have come within a spacing of each other since the last look.
    pub fn look(&mut self, moment: &Moment) -> Vec<String> {
        let scene = moment.scene;
        if !Self::possible(scene) {
            return Vec::new();
        }
        let reach = 0.5 * (1.0 + ROUNDING);
        let names = |a: usize, b: usize| [&scene.bodies[a].group, &scene.bodies[b].group].map(String::clone);
        let asked = |a: usize, b: usize| scene.strangers[a][b] && !self.told.contains(&names(a.min(b), a.max(b)));
        let count = scene.bodies.len();
        let watched: Vec<bool> = (0..count).map(|a| (0..count).any(|b| asked(a, b))).collect();
        let mut bodies = vec![Vec::new(); count];
        for (i, particle) in scene.particles.iter().enumerate().filter(|(_, particle)| watched[particle.body as usize]) {
            bodies[particle.body as usize].push(DVec3::from_array(moment.position(i)));
        }
        let boxes: Vec<(DVec3, DVec3)> =
            bodies.iter().zip(&scene.bodies).map(|(points, body)| around(points, reach * body.spacing)).collect();
        let mut lines = Vec::new();
        for (a, b) in near_pairs(&boxes) {
            let names = [&scene.bodies[a], &scene.bodies[b]].map(|body| body.group.clone());
            if !scene.strangers[a][b] || self.told.contains(&names) {
                continue;
            }
            let within = reach * (scene.bodies[a].spacing + scene.bodies[b].spacing);
            if let Some(place) = meeting([&bodies[a], &bodies[b]], [boxes[a], boxes[b]], within) {
                lines.push(sentence(moment.time, [&scene.bodies[a], &scene.bodies[b]], place, scene));
                self.told.insert(names);
            }
        }
        lines
    }
}

/// Whether a scene has bodies whose law of contact could give way.
pub fn may_cross(scene: &Scene) -> bool {
    let count = scene.bodies.len();
    (0..count).any(|a| (0..a).any(|b| touch(scene, a, b)))
}

fn touch(scene: &Scene, a: usize, b: usize) -> bool {
    a != b && (scene.contacts[a][b].range > 0.0 || scene.facet_pairs[a][b].stiffness > 0.0)
}

/// A sentence if a particle of one body lies in the midst of those of another, although a law is between the two.
pub fn crossed(moment: &Moment) -> Option<String> {
    let scene = moment.scene;
    let count = scene.bodies.len();
    if !may_cross(scene) {
        return None;
    }
    let watched: Vec<bool> = (0..count).map(|a| (0..count).any(|b| touch(scene, a, b))).collect();
    let mut bodies = vec![Vec::new(); count];
    for (i, particle) in scene.particles.iter().enumerate().filter(|(_, particle)| watched[particle.body as usize]) {
        bodies[particle.body as usize].push(DVec3::from_array(moment.position(i)));
    }
    let boxes: Vec<(DVec3, DVec3)> = bodies.iter().map(|points| around(points, 0.0)).collect();
    near_pairs(&boxes).into_iter().filter(|&(a, b)| touch(scene, a, b)).find_map(|(a, b)| {
        let within = INSIDE * scene.bodies[a].spacing.max(scene.bodies[b].spacing);
        let [own, other] = [&bodies[a], &bodies[b]];
        let least = 2 * scene.dimension();
        let inside = |points, boxes| midst(points, boxes, within, least);
        let place = inside([own, other], [boxes[a], boxes[b]]).or_else(|| inside([other, own], [boxes[b], boxes[a]]))?;
        let [_, _, unit] = scene.unit_names();
        Some(format!(
            "`{}` and `{}` pass through each other at {}, seen at t = {:.4e} {unit}: what is between them is too soft for this \
             impact; raise the stiffness of their [[contact]], or refine",
            scene.bodies[a].name,
            scene.bodies[b].name,
            words::place(place, scene.dimension()),
            moment.time
        ))
    })
}

/// A point of the second body that has so many points of the first, on all sides, within a distance (m).
fn midst(points: [&[DVec3]; 2], boxes: [(DVec3, DVec3); 2], within: f64, least: usize) -> Option<DVec3> {
    let near = Near::new(points[0], boxes, within);
    points[1].iter().copied().find(|&point| {
        let directions: Vec<DVec3> = near.of(point).map(|other| (other - point).normalize_or_zero()).collect();
        directions.len() >= least && directions.iter().sum::<DVec3>().length() < MIDST * directions.len() as f64
    })
}

fn sentence(time: f64, [a, b]: [&SceneBody; 2], place: DVec3, scene: &Scene) -> String {
    let [_, _, unit] = scene.unit_names();
    let (first, second) = if a.group == b.group { (&a.name, &b.name) } else { (&a.group, &b.group) };
    format!(
        "`{first}` and `{second}` come within a spacing of each other at t = {time:.4e} {unit}, at {}, and no law is between them: \
         they would pass through each other, and a face that they share carries no stress; name a [[contact]] between them: with a \
         law, with `tie = true` where they are bonded, or with `none = true` if this is meant",
        words::place(place, scene.dimension())
    )
}

/// The box around points, and further out by a margin (m).
fn around(points: &[DVec3], margin: f64) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = points.iter().fold(start, |(low, high), point| (low.min(*point), high.max(*point)));
    (low - margin, high + margin)
}

/// The middle between two points, one of either body, that lie within a distance (m) of each other: the first such.
fn meeting(points: [&[DVec3]; 2], boxes: [(DVec3, DVec3); 2], within: f64) -> Option<DVec3> {
    let near = Near::new(points[0], boxes, within);
    points[1].iter().find_map(|&point| {
        let distance = |other: &DVec3| other.distance_squared(point);
        near.of(point).min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|other| (other + point) / 2.0)
    })
}

/// Points of a body near another, by cells as wide as the distance (m) that is looked within.
struct Near {
    low: DVec3,
    high: DVec3,
    within: f64,
    cells: HashMap<I64Vec3, Vec<DVec3>>,
}

impl Near {
    /// Of the points those in both boxes, or a distance further out.
    fn new(points: &[DVec3], boxes: [(DVec3, DVec3); 2], within: f64) -> Self {
        let (low, high) = (boxes[0].0.max(boxes[1].0) - within, boxes[0].1.min(boxes[1].1) + within);
        let mut near = Self { low, high, within, cells: HashMap::new() };
        for &point in points {
            if near.holds(point) {
                near.cells.entry(near.cell(point)).or_default().push(point);
            }
        }
        near
    }

    fn holds(&self, point: DVec3) -> bool {
        point.cmpge(self.low).all() && point.cmple(self.high).all()
    }

    fn cell(&self, point: DVec3) -> I64Vec3 {
        ((point - self.low) / self.within).floor().as_i64vec3()
    }

    /// Points within the distance of a point.
    fn of(&self, point: DVec3) -> impl Iterator<Item = DVec3> {
        let cells = if self.holds(point) { 27 } else { 0 };
        let around = (0..cells).map(|k| I64Vec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        let others = around.filter_map(move |step| self.cells.get(&(self.cell(point) + step))).flatten();
        others.copied().filter(move |other| other.distance(point) < self.within)
    }
}
