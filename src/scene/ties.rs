//! Bodies that are bonded where they share a face: the weights of their bonds, and what they must have in common.

use super::copies::pairs;
use super::file::{ContactTable, File};
use super::groups::{Group, difference};
use super::refuse::Refuse;
use super::{Scene, SceneBody};
use crate::method::Formulation;

/// Distances, in spacings, between which the nearest particles of two tied bodies lie.
const NEAREST: [f64; 2] = [0.7, 1.3];

/// Puts the weights of the bonds between two tied bodies into the table: for an end of modulus E_a, 2 E_b/(E_a + E_b). Why, the
/// head of `src/bond.rs` says.
///
/// # Errors
/// One sentence where the two cannot be tied.
pub(super) fn join(
    table: &mut [Vec<f64>],
    bodies: &[SceneBody],
    groups: &[Group],
    (at, contact): (&str, &ContactTable),
    refuse: &Refuse,
) -> Result<(), String> {
    let path = ["contact", at, "tie"];
    let other_law = contact.kernel.is_some() || contact.touches() || contact.gap.is_some();
    refuse.unless(!other_law, &path, || {
        "tied bodies are bonded and do not touch: name no kernel, potential, colour_field, zones or gap beside tie".into()
    })?;
    for (a, b) in pairs(bodies, &contact.between) {
        refuse.unless(a != b, &path, || format!("`{}` is one body already: tie is for two", bodies[a].name))?;
        let of = |body: usize| groups.iter().find(|group| group.bodies.contains(&body)).unwrap_or(&groups[0]);
        for group in [of(a), of(b)] {
            kind(group, &path, refuse)?;
        }
        refuse.unless(of(a).bodies.contains(&b), &path, || {
            let key = difference(&of(a).formulation, &of(b).formulation);
            let names = [&bodies[a].name, &bodies[b].name];
            format!("`{}` and `{}` cannot be tied, since their formulations differ in {key}: give them one", names[0], names[1])
        })?;
        alike(&bodies[a], &bodies[b], &path, refuse)?;
        let modulus = |body: usize| bodies[body].material.youngs_modulus();
        for (a, b) in [(a, b), (b, a)] {
            table[a][b] = 2.0 * modulus(b) / (modulus(a) + modulus(b));
        }
    }
    Ok(())
}

fn kind(group: &Group, path: &[&str], refuse: &Refuse) -> Result<(), String> {
    match group.kind() {
        Formulation::TotalLagrangian => Ok(()),
        Formulation::Eulerian => Err(refuse.at(
            path,
            "tie belongs to formulation.kind `total_lagrangian`: the kernel joins Eulerian bodies without it, where no contact has kernel = 0",
        )),
        Formulation::CorrectedKernel => Err(refuse.at(
            path,
            "tie belongs to formulation.kind `total_lagrangian`, and `corrected_kernel` has none",
        )),
    }
}

/// Bonds are listed and weighed by one reach, so that those of two bodies go both ways.
fn alike(a: &SceneBody, b: &SceneBody, path: &[&str], refuse: &Refuse) -> Result<(), String> {
    let lengths = [("spacing", a.spacing, b.spacing), ("smoothing length", a.smoothing_length, b.smoothing_length)];
    for (what, one, two) in lengths {
        refuse.unless((one - two).abs() <= 1e-9 * one.max(two), path, || {
            format!("tied bodies need one {what}: that of `{}` is {one}, that of `{}` {two}", a.name, b.name)
        })?;
    }
    Ok(())
}

/// Refuses another contact between bodies that are tied, which words for copies may bring in.
pub(super) fn alone(file: &File, bodies: &[SceneBody], refuse: &Refuse) -> Result<(), String> {
    let sorted = |contact: &ContactTable| pairs(bodies, &contact.between).into_iter().map(|(a, b)| (a.min(b), a.max(b)));
    for (k, tied) in file.contact.iter().enumerate().filter(|(_, contact)| contact.tie) {
        let joined: Vec<(usize, usize)> = sorted(tied).collect();
        for (j, other) in file.contact.iter().enumerate().filter(|&(j, _)| j != k) {
            if let Some((a, b)) = sorted(other).find(|pair| joined.contains(pair)) {
                let message =
                    format!("`{}` and `{}` are tied by another [[contact]]: one is enough", bodies[a].name, bodies[b].name);
                return Err(refuse.at(&["contact", &j.to_string()], message));
            }
        }
    }
    Ok(())
}

/// Refuses tied bodies that do not go on in each other: somewhere their particles must be about a spacing apart, and nowhere much
/// less.
pub(super) fn meet(scene: &Scene, refuse: &Refuse) -> Result<(), String> {
    for (k, contact) in scene.file.contact.iter().enumerate().filter(|(_, contact)| contact.tie) {
        let at = k.to_string();
        let path = ["contact", &at, "tie"];
        let joined = pairs(&scene.bodies, &contact.between);
        let together = |a: u32, b: u32| joined.iter().any(|&(x, y)| [(x, y), (y, x)].contains(&(a as usize, b as usize)));
        let spacing = scene.bodies[joined[0].0].spacing;
        if let Some((distance, ends)) = scene.closest(NEAREST[0] * spacing, together) {
            let message = format!(
                "{} are {:.3} spacings apart at {}: tied bodies share a face and a lattice, with no particles nearer than {}; \
                 give them one anchor, and shapes that do not overlap",
                both(scene, ends),
                distance / spacing,
                place(scene, ends[0]),
                NEAREST[0]
            );
            return Err(refuse.at(&path, message));
        }
        // Of copies that are tied to each other, not every one meets every other.
        let mut bodies: Vec<usize> = joined.iter().flat_map(|&(a, b)| [a, b]).collect();
        bodies.sort_unstable();
        bodies.dedup();
        for body in bodies {
            let of_body = |a: u32, b: u32| (a as usize == body || b as usize == body) && together(a, b);
            if scene.closest(NEAREST[1] * spacing, of_body).is_some() {
                continue;
            }
            let (low, high) = scene.extent();
            let mut reach = NEAREST[1] * spacing;
            let mut found = None;
            while found.is_none() && reach < 2.0 * low.distance(high) {
                reach *= 2.0;
                found = scene.closest(reach, of_body);
            }
            let message = found.map_or_else(String::new, |(distance, ends)| {
                format!(
                    "{}, {:.3} spacings apart at {}, are the nearest: ",
                    both(scene, ends),
                    distance / spacing,
                    place(scene, ends[0])
                )
            });
            let what = format!(
                "{message}`{}` shares no face with what it is tied to; the nearest particles of tied bodies are at most {} spacings apart",
                scene.bodies[body].name, NEAREST[1]
            );
            return Err(refuse.at(&path, what));
        }
    }
    Ok(())
}

fn both(scene: &Scene, ends: [usize; 2]) -> String {
    let [a, b] = ends.map(|i| &scene.bodies[scene.particles[i].body as usize].name);
    format!("particles of `{a}` and `{b}`")
}

fn place(scene: &Scene, particle: usize) -> String {
    let x = scene.particles[particle].position.to_array();
    format!("{:?}", &x[..scene.file.dimension])
}

/// Bodies that one of the Total Lagrangian formulation is tied to.
pub(super) fn of(coupling: &[Vec<f64>], body: usize) -> impl Iterator<Item = usize> {
    coupling[body].iter().enumerate().filter(move |&(other, &weight)| other != body && weight > 0.0).map(|(other, _)| other)
}

/// Whether any bodies of the Total Lagrangian formulation are tied.
pub(super) fn any(coupling: &[Vec<f64>]) -> bool {
    (0..coupling.len()).any(|body| of(coupling, body).next().is_some())
}
