//! What a shape must fulfil before it is packed: one clear sentence for each impossible value.

use super::shape::{Coordinates, Shape, edges};
use glam::DVec2;

impl Shape {
    /// # Errors
    /// One sentence on the first value that makes no shape in a scene of this dimension.
    pub fn check(&self, dimension: usize) -> Result<(), String> {
        self.check_dimension(dimension)?;
        match self {
            Self::Block { min, max } => check_block(min, max, dimension),
            Self::Disc { center, radius } | Self::Sphere { center, radius } => {
                check_point("center", center)?;
                check_length("radius", *radius)
            }
            Self::Ring { center, inner, outer } => {
                check_point("center", center)?;
                check_wall(*inner, *outer)
            }
            Self::Cylinder { center, axis, radius, length } => {
                check_point("center", center)?;
                check_axis(axis)?;
                check_length("radius", *radius)?;
                check_length("length", *length)
            }
            Self::Tube { center, axis, inner, outer, length } => {
                check_point("center", center)?;
                check_axis(axis)?;
                check_wall(*inner, *outer)?;
                check_length("length", *length)
            }
            Self::Polygon { points } => check_polygon(points),
            Self::Union { of } => check_parts("a union", "of", of, dimension),
            Self::Intersection { of } => check_parts("an intersection", "of", of, dimension),
            Self::Cut { from, remove } => {
                from.check(dimension)?;
                check_parts("a cut", "remove", remove, dimension)
            }
        }
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), String> {
        let (name, needed, instead) = match self {
            Self::Disc { .. } => ("a disc", 2, "a sphere or a cylinder"),
            Self::Ring { .. } => ("a ring", 2, "a tube"),
            Self::Polygon { .. } => ("a polygon", 2, "blocks, cylinders and their cuts"),
            Self::Sphere { .. } => ("a sphere", 3, "a disc"),
            Self::Cylinder { .. } => ("a cylinder", 3, "a disc or a block"),
            Self::Tube { .. } => ("a tube", 3, "a ring"),
            _ => return Ok(()),
        };
        let instead = if dimension == 1 { "a block" } else { instead };
        if dimension == needed {
            return Ok(());
        }
        Err(format!("{name} needs a {needed}D scene: in {dimension}D use {instead}"))
    }
}

fn check_block(min: &Coordinates, max: &Coordinates, dimension: usize) -> Result<(), String> {
    check_point("min", min)?;
    check_point("max", max)?;
    let (min, max) = (min.vector(), max.vector());
    match (0..dimension).find(|&axis| min[axis] >= max[axis]) {
        None => Ok(()),
        Some(axis) => Err(format!(
            "a block needs min < max on each axis, but on {} min is {} and max is {}",
            ["x", "y", "z"][axis],
            min[axis],
            max[axis]
        )),
    }
}

fn check_point(name: &str, point: &Coordinates) -> Result<(), String> {
    let count = point.0.len();
    if !(1..=3).contains(&count) {
        return Err(format!("{name} needs 1 to 3 numbers, not {count}"));
    }
    match point.0.iter().find(|number| !number.is_finite()) {
        None => Ok(()),
        Some(number) => Err(format!("{name} needs finite numbers, not {number}")),
    }
}

fn check_length(name: &str, length: f64) -> Result<(), String> {
    if length.is_finite() && length > 0.0 {
        return Ok(());
    }
    Err(format!("{name} must be above 0 and finite, not {length}"))
}

fn check_wall(inner: f64, outer: f64) -> Result<(), String> {
    check_length("inner", inner)?;
    check_length("outer", outer)?;
    if inner < outer {
        return Ok(());
    }
    Err(format!("inner must be below outer, but inner is {inner} and outer is {outer}"))
}

fn check_axis(axis: &Coordinates) -> Result<(), String> {
    check_point("axis", axis)?;
    if axis.vector().try_normalize().is_some() {
        return Ok(());
    }
    Err("axis must point somewhere, not be zero".to_string())
}

fn check_parts(name: &str, key: &str, parts: &[Shape], dimension: usize) -> Result<(), String> {
    if parts.is_empty() {
        return Err(format!("{name} needs at least one shape in `{key}`"));
    }
    parts.iter().try_for_each(|part| part.check(dimension))
}

fn check_polygon(points: &[Coordinates]) -> Result<(), String> {
    if points.len() < 3 {
        let count = points.len();
        return Err(format!("a polygon needs at least 3 points, not {count}"));
    }
    for point in points {
        check_point("a polygon's point", point)?;
        if point.0.len() != 2 {
            let count = point.0.len();
            return Err(format!("a polygon's point needs 2 numbers, not {count}"));
        }
    }
    let edges: Vec<_> = edges(points).collect();
    if let Some((corner, _)) = edges.iter().find(|(a, b)| a == b) {
        return Err(format!("a polygon has the point {corner} twice in a row"));
    }
    for (first, &edge) in edges.iter().enumerate() {
        for (second, &other) in edges.iter().enumerate().skip(first + 1) {
            let adjacent = second == first + 1 || (first == 0 && second == edges.len() - 1);
            let crosses = if adjacent { folds } else { meets };
            if crosses(edge, other) {
                return Err(format!("a polygon must not meet itself, but its edges {} and {} do", first + 1, second + 1));
            }
        }
    }
    Ok(())
}

/// Whether two edges that share a corner run back over each other.
fn folds(edge: (DVec2, DVec2), other: (DVec2, DVec2)) -> bool {
    let (shared, a, b) = if edge.1 == other.0 { (edge.1, edge.0, other.1) } else { (edge.0, edge.1, other.0) };
    (a - shared).perp_dot(b - shared) == 0.0 && (a - shared).dot(b - shared) > 0.0
}

/// Whether two edges that share no corner have a point in common.
fn meets(edge: (DVec2, DVec2), other: (DVec2, DVec2)) -> bool {
    let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
    let within =
        |line: (DVec2, DVec2), point: DVec2| turn(line.0, line.1, point) == 0.0 && (point - line.0).dot(point - line.1) <= 0.0;
    let apart = |line: (DVec2, DVec2), ends: (DVec2, DVec2)| turn(line.0, line.1, ends.0) * turn(line.0, line.1, ends.1) < 0.0;
    (apart(edge, other) && apart(other, edge))
        || within(edge, other.0)
        || within(edge, other.1)
        || within(other, edge.0)
        || within(other, edge.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(radius: f64) -> Shape {
        let center = [0.0, 0.0].into();
        Shape::Disc { center, radius }
    }

    fn polygon(points: &[[f64; 2]]) -> Shape {
        let points = points.iter().map(|&point| point.into()).collect();
        Shape::Polygon { points }
    }

    fn refusal(shape: &Shape, dimension: usize) -> String {
        shape.check(dimension).unwrap_err()
    }

    #[test]
    fn the_dimension_must_fit() {
        assert!(disc(1.0).check(2).is_ok());
        assert_eq!(refusal(&disc(1.0), 3), "a disc needs a 2D scene: in 3D use a sphere or a cylinder");
        let sphere = Shape::Sphere { center: [0.0].into(), radius: 1.0 };
        assert_eq!(refusal(&sphere, 2), "a sphere needs a 3D scene: in 2D use a disc");
        assert_eq!(refusal(&sphere, 1), "a sphere needs a 3D scene: in 1D use a block");
    }

    #[test]
    fn sizes_must_be_possible() {
        assert_eq!(refusal(&disc(-1.0), 2), "radius must be above 0 and finite, not -1");
        assert!(refusal(&disc(f64::NAN), 2).contains("NaN"));
        let ring = |inner, outer| Shape::Ring { center: [0.0, 0.0].into(), inner, outer };
        assert_eq!(refusal(&ring(3.0, 2.0), 2), "inner must be below outer, but inner is 3 and outer is 2");
        let flat = Shape::Block { min: [0.0, 0.0].into(), max: [1.0, 1.0].into() };
        assert!(flat.check(2).is_ok());
        assert!(refusal(&flat, 3).contains("on z min is 0 and max is 0"));
        let long = Shape::Disc { center: [0.0; 4].into(), radius: 1.0 };
        assert_eq!(refusal(&long, 2), "center needs 1 to 3 numbers, not 4");
    }

    #[test]
    fn polygons_must_be_simple() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert!(polygon(&square).check(2).is_ok());
        assert!(refusal(&polygon(&square[..2]), 2).contains("at least 3 points"));
        let bow = [square[0], square[2], square[1], square[3]];
        assert_eq!(refusal(&polygon(&bow), 2), "a polygon must not meet itself, but its edges 1 and 3 do");
        let spike = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(refusal(&polygon(&spike), 2).contains("edges 1 and 2"));
    }

    #[test]
    fn combinations_check_their_parts() {
        assert!(refusal(&Shape::Union { of: vec![] }, 2).contains("at least one shape in `of`"));
        let cut = Shape::Cut { from: Box::new(disc(2.0)), remove: vec![disc(0.0)] };
        assert!(refusal(&cut, 2).contains("radius"));
    }
}
