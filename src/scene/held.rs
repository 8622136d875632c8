//! What a boundary condition prescribes.

use super::file::{Axis, Boundary, Fixed};

const AXES: [&str; 3] = ["x", "y", "z"];

/// The axes along which a boundary condition prescribes the velocity, and that velocity, or else an acceleration: the force
/// over the mass of what it acts on.
///
/// # Errors
/// What is wrong with the condition, to follow its name.
pub(super) fn held(typed: &Boundary, dimension: usize, mass: f64) -> Result<([bool; 3], [f64; 3]), String> {
    let fixed = match &typed.fixed {
        Some(Fixed::All(true)) => Some(vec![true; dimension]),
        Some(Fixed::Axes(axes)) => Some(axes.clone()),
        Some(Fixed::All(false)) | None => None,
    };
    let counts = [("fixed", fixed.as_ref().map(Vec::len)), ("velocity", typed.velocity.as_ref().map(Vec::len))];
    if let Some((key, Some(count))) = counts.into_iter().find(|(_, count)| count.is_some_and(|count| count != dimension)) {
        return Err(format!("takes {dimension} components of `{key}`, one for each axis, found {count}"));
    }
    let (mut prescribed, mut vector) = ([false; 3], [0.0; 3]);
    match (&fixed, &typed.velocity, &typed.force) {
        (Some(_), Some(_), _) => {
            return Err("takes `fixed` or `velocity`, not both: an axis that is fixed has the velocity 0".into());
        }
        (None, None, None) => return Err("needs one of fixed, velocity or force".into()),
        (Some(axes), None, _) => prescribed[..dimension].copy_from_slice(axes),
        (None, Some(velocity), _) => {
            for (k, axis) in velocity.iter().enumerate() {
                if let Axis::Value(value) = axis {
                    (prescribed[k], vector[k]) = (true, *value);
                }
            }
        }
        (None, None, Some(_)) => (),
    }
    if let Some(force) = &typed.force {
        push(force.vector().to_array(), &mut vector, prescribed, dimension, mass)?;
    }
    if typed.course.is_some() && vector == [0.0; 3] {
        return Err("has a course, which scales a velocity or a force, and neither".into());
    }
    Ok((prescribed, vector))
}

/// Adds a force along the axes that are free.
fn push(force: [f64; 3], vector: &mut [f64; 3], prescribed: [bool; 3], dimension: usize, mass: f64) -> Result<(), String> {
    for (k, &part) in force.iter().enumerate().filter(|(_, part)| **part != 0.0) {
        let axis = AXES[k];
        if k >= dimension {
            return Err(format!("has a force along {axis}, an axis that a scene of {dimension} dimensions does not have"));
        }
        if prescribed[k] {
            return Err(format!(
                "has a force along {axis}, where `fixed` or `velocity` prescribes the motion: a force cannot act on what is \
                 fixed; let the axis free, or take the force away"
            ));
        }
        vector[k] = part / mass;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<([bool; 3], [f64; 3]), String> {
        let boundary: Boundary = toml::from_str(&format!("select = {{ body = 'b' }}\n{text}")).unwrap();
        held(&boundary, 2, 2.0)
    }

    #[test]
    fn forces_act_along_free_axes_alone() {
        let free = [false; 3];
        assert_eq!(of("force = [0, -4]"), Ok((free, [0.0, -2.0, 0.0])));
        assert_eq!(of("fixed = false\nforce = [0, -4]"), Ok((free, [0.0, -2.0, 0.0])));
        assert_eq!(of("fixed = [true, false]\nforce = [0, -4]"), Ok(([true, false, false], [0.0, -2.0, 0.0])));
        assert_eq!(of("velocity = ['free', 3]\nforce = [4, 0]"), Ok(([false, true, false], [2.0, 3.0, 0.0])));
        for text in
            ["fixed = true\nforce = [0, -50]", "fixed = [true, false]\nforce = [1, 0]", "velocity = ['free', 3]\nforce = [0, 4]"]
        {
            let said = of(text).unwrap_err();
            assert!(said.contains("a force cannot act on what is fixed"), "{text}: {said}");
        }
    }

    #[test]
    fn each_slip_has_its_sentence() {
        let cases = [
            ("fixed = [true]", "takes 2 components of `fixed`"),
            ("velocity = [1, 2, 3]", "takes 2 components of `velocity`"),
            ("fixed = true\nvelocity = [1, 2]", "not both"),
            ("", "needs one of fixed, velocity or force"),
            ("force = [0, 0, 1]", "along z, an axis that a scene of 2 dimensions"),
            ("fixed = true\ncourse = [[0, 1], [1, 2]]", "has a course"),
        ];
        for (text, words) in cases {
            let said = of(text).unwrap_err();
            assert!(said.contains(words), "{text}: {said}");
        }
    }
}
