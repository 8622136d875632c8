//! What a scene may mean but most likely does not: a run says it once and goes on.

use super::Scene;
use super::file::BodyTable;
use super::groups::of_body;
use super::members::factor;
use super::refuse::Refuse;
use super::shape::Coordinates;
use crate::method::Formulation;
use glam::DVec3;

/// One sentence for each thing that a reader of the results would misread, each beginning with the place where it was typed;
/// `thin` are those on the parts of bodies that are two layers thin.
pub(super) fn warnings(scene: &Scene, thin: Vec<(usize, String)>, refuse: &Refuse) -> Vec<String> {
    let of_bodies = [scene.mass_warnings(), thin, scene.held_warnings()].concat();
    let of_bodies = of_bodies.into_iter().map(|(body, line)| refuse.at(&["body", &body.to_string(), "shape"], line));
    let stepped = super::surface::warnings(scene, refuse);
    let waves = scene.wave_warnings(refuse);
    courses(scene, refuse).into_iter().chain(waves).chain(tension(scene, refuse)).chain(of_bodies).chain(stepped).collect()
}

/// Eulerian solids that something strains, with nothing against the tensile instability. A scene that means it types an epsilon
/// of 0.
fn tension(scene: &Scene, refuse: &Refuse) -> Option<String> {
    let file = &scene.file;
    let bare = |k: usize| {
        of_body(file, k).is_some_and(|formulation| {
            formulation.kind == Formulation::Eulerian
                && formulation.artificial_stress.is_none()
                && scene.bodies[k].material.shear_modulus > 0.0
        })
    };
    let mut names: Vec<&str> =
        (0..file.body.len()).filter(|&k| bare(k) && strained(scene, k)).map(|k| &*scene.bodies[k].group).collect();
    names.dedup();
    let first = scene.bodies.iter().position(|body| Some(&&*body.group) == names.first())?;
    let path: Vec<&str> = ["formulation"].into_iter().chain(file.body[first].formulation.as_deref()).collect();
    Some(refuse.at(
        &path,
        format!(
            "`{}`: a solid of the Eulerian formulation without artificial_stress, which clumps and breaks for numerical reasons \
             where it is pulled: give it one, such as `artificial_stress = {{ epsilon = 0.3 }}`, or take a law of the \
             formulation `total_lagrangian`",
            names.join("`, `")
        ),
    ))
}

/// Whether a body may be pulled: by what is prescribed, by its own state or motion, or by the wave that an impact sends back.
fn strained(scene: &Scene, k: usize) -> bool {
    let (file, own) = (&scene.file, &scene.file.body[k]);
    let loaded = file.boundary.iter().any(|typed| typed.velocity.is_some() || typed.force.is_some());
    let forced = file.body_force.as_ref().is_some_and(|force| force.iter().any(|&part| part != 0.0));
    let stretched = own.relative_volume.is_some_and(|volume| volume > 1.0) || own.deviatoric_stress.is_some();
    let state = |body: &BodyTable| {
        let (low, high) = body.shape.bounds(file.dimension);
        (0.5 * (low + high), body.velocity.as_ref().map_or(DVec3::ZERO, Coordinates::vector))
    };
    let (place, velocity) = state(own);
    let approaches = |other: &BodyTable| {
        let (there, other) = state(other);
        (velocity - other).dot(there - place) > 0.0
    };
    loaded || forced || stretched || own.spin != 0.0 || own.motion.is_some() || file.body.iter().any(approaches)
}

/// Courses of loads that the run does not follow to their end.
fn courses(scene: &Scene, refuse: &Refuse) -> Vec<String> {
    let file = &scene.file;
    let name = |k: usize, name: &Option<String>| name.clone().unwrap_or_else(|| format!("boundary {}", k + 1));
    let boundaries = file.boundary.iter().enumerate();
    let of_boundaries = boundaries.map(|(k, typed)| ("boundary", k, name(k, &typed.name), &typed.course));
    let of_obstacles = file.obstacle.iter().enumerate().map(|(k, typed)| ("obstacle", k, typed.name.clone(), &typed.course));
    let cut = |(table, k, name, course): (&str, usize, String, &Option<Vec<[f64; 2]>>)| {
        let left_out = left_out(course.as_deref()?, file.duration, scene.unit_names()[2])?;
        Some(refuse.at(&[table, &k.to_string(), "course"], format!("the course of `{name}` {left_out}")))
    };
    of_boundaries.chain(of_obstacles).filter_map(cut).collect()
}

/// What of a course lies after the duration, if anything that differs from what lies before.
fn left_out(course: &[[f64; 2]], duration: f64, unit: &str) -> Option<String> {
    let (first, last) = (course.first()?, course.last()?);
    let remedy = format!("times are in {unit}, as the duration is: shorten the course, or lengthen the run");
    let reached = factor(course, duration);
    let within = course.iter().filter(|point| point[0] <= duration).map(|point| point[1].abs());
    let largest = within.fold(reached.abs(), f64::max);
    if course.iter().all(|point| point[0] <= duration * (1.0 + 1e-9) || point[1] == reached) {
        return None;
    }
    if first[0] >= duration {
        return Some(format!(
            "begins at {}, when the run of {duration} is over: its factor stays {}; {remedy}",
            first[0], first[1]
        ));
    }
    let whole = course.iter().map(|point| point[1].abs()).fold(0.0, f64::max);
    Some(format!(
        "ends at {}, after the run of {duration}: of its largest factor, {whole}, the run reaches {:.3} %; {remedy}",
        last[0],
        100.0 * largest / whole
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_that_the_run_cuts_says_how_much_is_reached() {
        let said = left_out(&[[0.0, 0.0], [20.0, 1.0]], 0.02, "s").unwrap();
        assert!(said.contains("ends at 20, after the run of 0.02") && said.contains("reaches 0.100 %"), "{said}");
        let late = left_out(&[[5.0, 0.0], [6.0, 1.0]], 0.02, "s").unwrap();
        assert!(late.contains("begins at 5") && late.contains("stays 0"), "{late}");
        let half = left_out(&[[0.0, 0.0], [0.01, 1.0], [0.03, 0.0]], 0.02, "s").unwrap();
        assert!(half.contains("reaches 100.000 %"), "{half}");
    }

    #[test]
    fn a_course_whose_rest_changes_nothing_is_not_named() {
        assert_eq!(left_out(&[[0.0, 0.0], [0.02, 1.0]], 0.02, "s"), None);
        assert_eq!(left_out(&[[0.0, 0.0], [0.01, 1.0], [9.0, 1.0]], 0.02, "s"), None);
        assert_eq!(left_out(&[], 0.02, "s"), None);
    }
}
