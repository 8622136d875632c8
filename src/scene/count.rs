//! How many particles a scene will have and what they will take, before any of them is made: a slip in the unit of a spacing
//! asks for more than a machine has, and is refused at once.

use super::file::{BodyTable, File};
use super::groups::Group;
use super::packing::{MOST_POINTS, Packing, Point};
use super::refuse::Refuse;
use super::resolve::method;
use super::{Particle, Scene, SceneBody};
use crate::fields::Counts;
use crate::memory;
use crate::method::Method;
use crate::rows::{ContactPair, FacetPair};
use crate::step;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Particles below which nothing is estimated: they fit any machine.
const FEW: f64 = 1e6;
/// Bytes below which the tables of pairs are not looked at.
const MUCH: f64 = 1e8;
/// Bytes that packing takes for a particle. Lists grow by doubling, so that each may be there twice.
const PACKED: usize = 2 * (size_of::<Point>() + size_of::<Particle>());
/// Bytes that the tables of pairs take for two bodies: coupling, contact and gap.
const PAIR: usize = size_of::<f64>() + size_of::<ContactPair<f64>>() + size_of::<FacetPair<f64>>();

/// Refuses a scene whose particles are more than their indices can count, or take more memory than this process can have.
///
/// # Errors
/// One sentence with the number of particles, what they take, and the spacing that would do.
pub(super) fn check(file: &File, bodies: &[SceneBody], groups: &[Group], refuse: &Refuse) -> Result<(), String> {
    let counts: Vec<f64> = file.body.iter().zip(bodies).map(|(typed, body)| likely(file, typed, body)).collect();
    let total: f64 = counts.iter().sum();
    let pairs = (PAIR * bodies.len() * bodies.len()) as f64;
    if total < FEW && pairs < MUCH {
        return Ok(());
    }
    let largest = (0..counts.len()).max_by(|&a, &b| counts[a].total_cmp(&counts[b])).unwrap_or(0);
    let at = largest.to_string();
    let free = memory::available().map_or(f64::INFINITY, |bytes| bytes as f64);
    refuse.unless(pairs < 0.5 * free, &["body", &at, "copies"], || {
        format!("the tables of pairs of {} bodies take {}, and {} are free", bodies.len(), size(pairs), size(free))
    })?;
    let mut each = PACKED as f64;
    for group in groups {
        each = each.max(PACKED as f64 + columns(file, bodies, group, refuse)?);
    }
    let most = ((free - pairs) / each).min(MOST_POINTS as f64);
    let path: &[&str] = if file.body[largest].spacing.is_some() { &["body", &at, "spacing"] } else { &["spacing"] };
    refuse.unless(total <= most, path, || {
        let spacing = bodies[largest].spacing;
        let fits = rounded_up(spacing * (1.05 * total / most).powf(1.0 / file.dimension as f64));
        format!(
            "spacing {spacing} makes about {:.1e} particles of body `{}`; {total:.1e} particles take {} or more, {} are free, and \
             a run holds at most {MOST_POINTS}: spacing {fits} fits",
            counts[largest],
            bodies[largest].name,
            size(total * each),
            size(free)
        )
    })
}

/// Bytes in words.
fn size(bytes: f64) -> String {
    format!("{:.1} GB", bytes / 1e9)
}

/// To two digits.
fn rounded_up(length: f64) -> String {
    let unit = 10f64.powf(length.log10().floor() - 1.0);
    format!("{:.1e}", (length / unit).ceil() * unit)
}

/// Particles that a body will have, about.
fn likely(file: &File, typed: &BodyTable, body: &SceneBody) -> f64 {
    // A shape that cannot be is refused, with its reason, when it is packed.
    if typed.shape.check(file.dimension).is_err() {
        return 0.0;
    }
    denser(typed.packing(), file.dimension) * typed.shape.volume(file.dimension) / body.spacing.powi(file.dimension as i32)
}

/// Particles in a cube of one spacing.
fn denser(packing: Packing, dimension: usize) -> f64 {
    match (packing, dimension) {
        (Packing::Hexagonal, 2) => 0.75f64.sqrt().recip(),
        (Packing::Hexagonal, 3) => 2f64.sqrt(),
        _ => 1.0,
    }
}

/// Bytes that the columns of a group's particle take in single precision, without those of surfaces, contacts and cells.
fn columns(file: &File, bodies: &[SceneBody], group: &Group, refuse: &Refuse) -> Result<f64, String> {
    let own: Vec<SceneBody> = group.bodies.iter().map(|&k| bodies[k].clone()).collect();
    let formulation = &group.formulation;
    let named = Refuse { formulation: group.name.as_deref(), ..*refuse };
    let mut method = method(&Scene::unpacked(group.view(file), own, refuse), &named)?;
    (method.constraints, method.obstacles) = (!file.boundary.is_empty(), !file.obstacle.is_empty());
    method.compensated = true;
    let follows = method.list_follows();
    let reach = formulation.smoothing_length * (2.0 + if follows { file.list_margin() } else { 0.0 });
    let inside = [2.0 * reach, PI * reach.powi(2), 4.0 / 3.0 * PI * reach.powi(3)][file.dimension - 1];
    let crowding = if follows { [3.0, 2.0, 1.5][file.dimension - 1] } else { 1.0 };
    let list_capacity = formulation.list_capacity.map_or((inside * crowding) as usize, |typed| typed as usize);
    let counts = Counts { particles: 1, list_capacity, ..Counts::default() };
    Ok(counts.bytes(&step::fields(&method), file.dimension, 4) as f64)
}

impl Scene {
    /// A scene whose bodies hold no particles yet: enough to say what its method is.
    fn unpacked(file: File, bodies: Vec<SceneBody>, refuse: &Refuse) -> Self {
        Self {
            name: String::new(),
            variant: None,
            method: Method { dimension: file.dimension, ..Method::default() },
            file,
            text: String::new(),
            source: refuse.source.clone(),
            parts: Vec::new(),
            first_number: 0,
            part_of: None,
            bodies,
            coupling: Vec::new(),
            contacts: Vec::new(),
            facet_pairs: Vec::new(),
            strangers: Vec::new(),
            obstacles: Vec::new(),
            facets: Vec::new(),
            constraints: Vec::new(),
            particles: Vec::new(),
            period: [0.0; 3],
            planes: Vec::new(),
            artificial_spacing: 0.0,
            warnings: Vec::new(),
            most_bonds: OnceLock::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::shape::Shape;
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_likely_number_is_the_packed_one_within_a_few_percent() {
        let cases = [
            ("block = { min = [0, 0], max = [40, 30] }", 2),
            ("ring = { center = [0, 0], inner = 30, outer = 35 }", 2),
            ("polygon = { points = [[0, 0], [40, 0], [0, 50]] }", 2),
            (
                "cut = { from = { block = { min = [0, 0], max = [40, 40] } }, remove = [{ disc = { center = [20, 20], radius = 15 } }] }",
                2,
            ),
            (
                "intersection = { of = [{ disc = { center = [0, 0], radius = 40 } }, { block = { min = [0, 0], max = [99, 99] } }] }",
                2,
            ),
            ("sphere = { center = [0, 0, 0], radius = 14 }", 3),
            ("tube = { center = [0, 0, 0], inner = 9, outer = 14, length = 30 }", 3),
        ];
        for (text, dimension) in cases {
            let shape: Shape = toml::from_str(text).unwrap();
            for packing in [Packing::Square, Packing::Hexagonal] {
                let points =
                    super::super::packing::fill(&shape, packing, 0.5, DVec3::splat(0.21), dimension).unwrap().len() as f64;
                let estimate = denser(packing, dimension) * shape.volume(dimension) / 0.5f64.powi(dimension as i32);
                assert!((estimate / points - 1.0).abs() < 0.03, "{text} {packing:?}: {estimate} for {points}");
            }
        }
    }

    #[test]
    fn a_spacing_is_rounded_to_what_surely_fits() {
        assert_eq!((rounded_up(0.00123), rounded_up(2.0), rounded_up(15.01)), ("1.3e-3".into(), "2.0e0".into(), "1.6e1".into()));
    }
}
