//! Shapes that are the same at each point of an axis.

use crate::scene::shape::{Coordinates, Shape};

pub fn along(axis: &Coordinates) -> bool {
    let vector = axis.vector();
    vector.x == 0.0 && vector.y == 0.0 && vector.z != 0.0
}

pub fn alike(a: [f64; 2], b: [f64; 2]) -> bool {
    (0..2).all(|k| (a[k] - b[k]).abs() <= 1e-9 * (a[1] - a[0]).abs())
}

/// What a shape that is the same at each point of an axis spans of it; `None` where it is not.
pub fn span(shape: &Shape, axis: usize) -> Option<[f64; 2]> {
    let same = |parts: &[Shape]| {
        let first = span(parts.first()?, axis)?;
        parts[1..].iter().all(|part| span(part, axis).is_some_and(|own| alike(first, own))).then_some(first)
    };
    match shape {
        Shape::Block { min, max } => Some([min.vector()[axis], max.vector()[axis]]),
        Shape::Cylinder { center, axis: of, length, .. } | Shape::Tube { center, axis: of, length, .. }
            if axis == 2 && along(of) =>
        {
            let middle = center.vector().z;
            Some([middle - 0.5 * length, middle + 0.5 * length])
        }
        Shape::Union { of } | Shape::Intersection { of } => same(of),
        Shape::Cut { from, remove } => {
            let whole = span(from, axis)?;
            let through = |part: &Shape| span(part, axis).is_some_and(|own| own[0] <= whole[0] && own[1] >= whole[1]);
            remove.iter().all(through).then_some(whole)
        }
        _ => None,
    }
}

/// A shape in one dimension less, as TOML; `None` where it can stay as typed, since a block ignores what it has too much.
pub fn flattened(shape: &Shape, axis: usize) -> Option<String> {
    let disc = |center: &Coordinates| format!("center = {:?}", &center.vector().to_array()[..axis]);
    let all = |parts: &[Shape]| parts.iter().map(|part| text(part, axis)).collect::<Vec<_>>().join(", ");
    match shape {
        Shape::Cylinder { center, radius, .. } => Some(format!("{{ disc = {{ {}, radius = {radius:?} }} }}", disc(center))),
        Shape::Tube { center, inner, outer, .. } => {
            Some(format!("{{ ring = {{ {}, inner = {inner:?}, outer = {outer:?} }} }}", disc(center)))
        }
        Shape::Union { of } => Some(format!("{{ union = {{ of = [{}] }} }}", all(of))),
        Shape::Intersection { of } => Some(format!("{{ intersection = {{ of = [{}] }} }}", all(of))),
        Shape::Cut { from, remove } => Some(format!("{{ cut = {{ from = {}, remove = [{}] }} }}", text(from, axis), all(remove))),
        _ => None,
    }
}

fn text(shape: &Shape, axis: usize) -> String {
    match shape {
        Shape::Block { min, max } => {
            let corner = |point: &Coordinates| point.vector().to_array()[..axis].to_vec();
            format!("{{ block = {{ min = {:?}, max = {:?} }} }}", corner(min), corner(max))
        }
        other => flattened(other, axis).unwrap_or_default(),
    }
}
