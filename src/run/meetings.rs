//! Watches for bodies that come close with no law between them: they pass through each other, and nothing else says so.

use crate::observable::Moment;
use crate::scene::strangers::near_pairs;
use crate::scene::words;
use crate::scene::{Scene, SceneBody};
use glam::DVec3;
use std::collections::{BTreeSet, HashMap};

/// Bodies that lie on one lattice and share a face are exactly one spacing apart; rounding shall not decide whether that is told.
const ROUNDING: f64 = 1e-6;

/// What was told so far.
#[derive(Debug, Default)]
pub struct Meetings {
    told: BTreeSet<[String; 2]>,
}

impl Meetings {
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

fn sentence(time: f64, [a, b]: [&SceneBody; 2], place: DVec3, scene: &Scene) -> String {
    let [_, _, unit] = scene.unit_names();
    let (first, second) = if a.group == b.group { (&a.name, &b.name) } else { (&a.group, &b.group) };
    format!(
        "`{first}` and `{second}` come within a spacing of each other at t = {time:.4e} {unit}, at {}, and no law is between them: \
         they pass through each other; name a [[contact]] between them, with a law or, if that is meant, with `none = true`",
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
    let (low, high) = (boxes[0].0.max(boxes[1].0) - within, boxes[0].1.min(boxes[1].1) + within);
    let near = |point: &&DVec3| point.cmpge(low).all() && point.cmple(high).all();
    let cell = |point: DVec3| ((point - low) / within).floor().as_i64vec3();
    let mut cells: HashMap<glam::I64Vec3, Vec<DVec3>> = HashMap::new();
    points[0].iter().filter(near).for_each(|&point| cells.entry(cell(point)).or_default().push(point));
    let around: Vec<glam::I64Vec3> = (0..27).map(|k| glam::I64Vec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)).collect();
    points[1].iter().filter(near).find_map(|&point| {
        let others = around.iter().filter_map(|step| cells.get(&(cell(point) + *step))).flatten();
        let close = others.filter(|other| other.distance(point) < within).min_by(|a, b| {
            let distance = |other: &DVec3| other.distance_squared(point);
            distance(a).total_cmp(&distance(b))
        });
        close.map(|other| (*other + point) / 2.0)
    })
}
