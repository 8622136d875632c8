//! What a scene may mean but most likely does not: a run says it once and goes on.

use super::Scene;
use super::refuse::Refuse;

/// One sentence for each thing that a reader of the results would misread, each beginning with the place where it was typed.
pub(super) fn warnings(scene: &Scene, refuse: &Refuse) -> Vec<String> {
    courses(scene, refuse)
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

/// The factor of a course at a time: linear between its points, constant outside.
pub(super) fn factor(course: &[[f64; 2]], time: f64) -> f64 {
    let after = course.partition_point(|point| point[0] <= time);
    match (after.checked_sub(1).map(|before| course[before]), course.get(after)) {
        (Some(a), Some(b)) => a[1] + (b[1] - a[1]) * (time - a[0]) / (b[0] - a[0]),
        (Some(end), None) => end[1],
        (None, first) => first.map_or(1.0, |point| point[1]),
    }
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
