//! Exact area and first moment of a plane shape within a square cell.
//!
//! The cell is cut into horizontal slabs at every height where the outline changes character: at
//! corners, at the top and bottom of circles, where outlines cross each other or the cell's sides.
//! Within a slab the same lines and arcs bound the shape from left to right, so one scan line names
//! them and their integrals are closed formulas.

use super::shape::{Coordinates, Shape, edges};
use glam::DVec2;

/// A piece of outline, m.
#[derive(Debug, Clone, Copy)]
enum Edge {
    Line {
        from: DVec2,
        to: DVec2,
    },
    /// The right (`side` = 1) or left (-1) half of a circle.
    Arc {
        center: DVec2,
        radius: f64,
        side: f64,
    },
}

impl Edge {
    fn upright(x: f64) -> Self {
        let (from, to) = (DVec2::new(x, 0.0), DVec2::new(x, 1.0));
        Self::Line { from, to }
    }

    fn x(&self, y: f64) -> f64 {
        match *self {
            // Kept apart because an upright line may stand at infinity.
            Self::Line { from, to } if from.x == to.x => from.x,
            Self::Line { from, to } => from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x),
            Self::Arc { center, radius, side } => center.x + side * half_chord(radius, y - center.y),
        }
    }

    /// Area (m2) and first moment (m3) about `origin` of what lies between x = origin.x and this
    /// edge, from height `low` to `high`.
    fn integrate(&self, origin: DVec2, low: f64, high: f64) -> (f64, DVec2) {
        let height = high - low;
        let middle = (low + high) / 2.0;
        match *self {
            Self::Line { from, to } => {
                let x = self.x(middle) - origin.x;
                let slope = (to.x - from.x) / (to.y - from.y);
                let spread = slope * height.powi(3) / 12.0;
                let first = (x * x * height + slope * spread) / 2.0;
                let second = (middle - origin.y) * x * height + spread;
                (x * height, DVec2::new(first, second))
            }
            Self::Arc { center, radius, side } => {
                let offset = center - origin;
                let low = (low - center.y).clamp(-radius, radius);
                let high = (high - center.y).clamp(-radius, radius);
                let area = side * (segment(radius, high) - segment(radius, low));
                let lift = side * (half_chord(radius, low).powi(3) - half_chord(radius, high).powi(3)) / 3.0;
                let square = radius * radius * (high - low) - (high.powi(3) - low.powi(3)) / 3.0;
                let first = (offset.x * offset.x * height + square) / 2.0 + offset.x * area;
                let second = offset.x * height * (middle - origin.y) + lift + offset.y * area;
                (offset.x * height + area, DVec2::new(first, second))
            }
        }
    }

    /// Heights at which the whole circle or segment has this x.
    fn heights_at(&self, x: f64) -> Vec<f64> {
        match *self {
            Self::Line { from, to } => {
                let share = (x - from.x) / (to.x - from.x);
                let on = (0.0..=1.0).contains(&share);
                on.then_some(from.y + share * (to.y - from.y)).into_iter().collect()
            }
            Self::Arc { center, radius, .. } => {
                let half = half_chord(radius, x - center.x);
                vec![center.y - half, center.y + half]
            }
        }
    }

    /// Heights of the ends of a segment or of the top and bottom of a circle.
    fn ends(&self) -> [f64; 2] {
        match *self {
            Self::Line { from, to } => [from.y, to.y],
            Self::Arc { center, radius, .. } => [center.y - radius, center.y + radius],
        }
    }
}

/// Half the chord (m) of a circle at a distance from its center.
fn half_chord(radius: f64, away: f64) -> f64 {
    ((radius - away) * (radius + away)).max(0.0).sqrt()
}

/// Area (m2) of the right half of a disc between its center and a height.
fn segment(radius: f64, height: f64) -> f64 {
    (height * half_chord(radius, height) + radius * radius * (height / radius).asin()) / 2.0
}

/// Heights at which two outlines cross; a touching pair may be left out, it bounds no area.
fn crossings(a: &Edge, b: &Edge) -> Vec<f64> {
    match (*a, *b) {
        (Edge::Line { from, to }, Edge::Line { from: start, to: end }) => {
            let (along, other) = (to - from, end - start);
            let turn = along.perp_dot(other);
            let share = (start - from).perp_dot(other) / turn;
            let on = (0.0..=1.0).contains(&share);
            on.then_some(from.y + share * along.y).into_iter().collect()
        }
        (Edge::Line { from, to }, Edge::Arc { center, radius, .. })
        | (Edge::Arc { center, radius, .. }, Edge::Line { from, to }) => {
            let along = (to - from).normalize();
            let foot = from + (center - from).dot(along) * along;
            let half = half_chord(radius, foot.distance(center));
            [foot + half * along, foot - half * along]
                .into_iter()
                .filter(|point| (point - from).dot(point - to) <= 0.0)
                .map(|point| point.y)
                .collect()
        }
        (Edge::Arc { center, radius, .. }, Edge::Arc { center: other, radius: reach, .. }) => {
            let apart = center.distance(other);
            if apart == 0.0 || apart > radius + reach || apart < (radius - reach).abs() {
                return Vec::new();
            }
            let along = (other - center) / apart;
            let foot = (apart * apart + (radius - reach) * (radius + reach)) / (2.0 * apart);
            let half = half_chord(radius, foot) * along.perp();
            let foot = center + foot * along;
            vec![(foot + half).y, (foot - half).y]
        }
    }
}

/// The stretch of a scan line between two edges.
struct Span {
    start: Edge,
    end: Edge,
}

/// The stretches covered by at least `needed` of the given ones, left to right.
fn covered(spans: Vec<Span>, needed: i32, y: f64) -> Vec<Span> {
    let ends = spans.iter().flat_map(|span| [(span.start, 1), (span.end, -1)]);
    let mut ends: Vec<_> = ends.map(|(edge, change)| (edge.x(y), change, edge)).collect();
    // At the same x what begins comes first, so that touching parts join.
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let mut depth = 0;
    let mut start = None;
    let mut result = Vec::new();
    for (_, change, edge) in ends {
        depth += change;
        if depth >= needed {
            start = start.or(Some(edge));
        } else if let Some(start) = start.take() {
            result.push(Span { start, end: edge });
        }
    }
    result
}

fn outside(spans: Vec<Span>, y: f64) -> Vec<Span> {
    let mut start = Edge::upright(f64::NEG_INFINITY);
    let mut result = Vec::new();
    for span in covered(spans, 1, y) {
        let end = span.start;
        result.push(Span { start, end });
        start = span.end;
    }
    let end = Edge::upright(f64::INFINITY);
    result.push(Span { start, end });
    result
}

/// A disc's stretch at a height.
fn chord(center: &Coordinates, radius: f64, y: f64) -> Vec<Span> {
    let center = center.plane();
    let arc = |side| Edge::Arc { center, radius, side };
    let span = Span { start: arc(-1.0), end: arc(1.0) };
    let crossed = (y - center.y).abs() < radius;
    crossed.then_some(span).into_iter().collect()
}

/// Corners of a block; in 1D a strip of height 2 about y = 0.
fn corners(min: &Coordinates, max: &Coordinates, dimension: usize) -> [Coordinates; 4] {
    let (mut min, mut max) = (min.plane(), max.plane());
    if dimension == 1 {
        (min.y, max.y) = (-1.0, 1.0);
    }
    [[min.x, min.y], [max.x, min.y], [max.x, max.y], [min.x, max.y]].map(Coordinates::from)
}

fn polygon_spans(points: &[Coordinates], y: f64) -> Vec<Span> {
    let mut crossed: Vec<_> =
        edges(points).filter(|(from, to)| (from.y > y) != (to.y > y)).map(|(from, to)| Edge::Line { from, to }).collect();
    crossed.sort_by(|a, b| a.x(y).total_cmp(&b.x(y)));
    let pairs = crossed.chunks_exact(2);
    pairs.map(|pair| Span { start: pair[0], end: pair[1] }).collect()
}

/// The stretches of the scan line at `y` that are inside the shape.
fn spans(shape: &Shape, dimension: usize, y: f64) -> Vec<Span> {
    let all = |parts: &[Shape]| -> Vec<Span> { parts.iter().flat_map(|part| spans(part, dimension, y)).collect() };
    let without = |mut from: Vec<Span>, removed: Vec<Span>| {
        from.extend(outside(removed, y));
        covered(from, 2, y)
    };
    match shape {
        Shape::Block { min, max } => polygon_spans(&corners(min, max, dimension), y),
        Shape::Polygon { points } => polygon_spans(points, y),
        Shape::Disc { center, radius } => chord(center, *radius, y),
        Shape::Ring { center, inner, outer } => without(chord(center, *outer, y), chord(center, *inner, y)),
        Shape::Union { of } => covered(all(of), 1, y),
        Shape::Cut { from, remove } => without(spans(from, dimension, y), all(remove)),
        Shape::Intersection { of } => covered(all(of), of.len() as i32, y),
        Shape::Sphere { .. } | Shape::Cylinder { .. } | Shape::Tube { .. } => Vec::new(),
    }
}

/// All lines and circles that bound the parts of a shape.
fn outline(shape: &Shape, dimension: usize) -> Vec<Edge> {
    let lines = |points: &[Coordinates]| -> Vec<Edge> { edges(points).map(|(from, to)| Edge::Line { from, to }).collect() };
    let circle = |center: &Coordinates, radius| Edge::Arc { center: center.plane(), radius, side: 1.0 };
    let all = |parts: &[Shape]| -> Vec<Edge> { parts.iter().flat_map(|part| outline(part, dimension)).collect() };
    match shape {
        Shape::Block { min, max } => lines(&corners(min, max, dimension)),
        Shape::Polygon { points } => lines(points),
        Shape::Disc { center, radius } => vec![circle(center, *radius)],
        Shape::Ring { center, inner, outer } => {
            vec![circle(center, *inner), circle(center, *outer)]
        }
        Shape::Union { of } | Shape::Intersection { of } => all(of),
        Shape::Cut { from, remove } => [outline(from, dimension), all(remove)].concat(),
        Shape::Sphere { .. } | Shape::Cylinder { .. } | Shape::Tube { .. } => Vec::new(),
    }
}

/// A shape of dimension 1 or 2, ready to be clipped by many cells.
pub struct Section<'a> {
    shape: &'a Shape,
    dimension: usize,
    outline: Vec<Edge>,
    /// Where the order of the outline along a scan line can change, ascending, m.
    heights: Vec<f64>,
}

impl<'a> Section<'a> {
    pub fn new(shape: &'a Shape, dimension: usize) -> Self {
        let outline = outline(shape, dimension);
        let mut heights: Vec<f64> = outline.iter().flat_map(Edge::ends).collect();
        for (index, a) in outline.iter().enumerate() {
            heights.extend(outline[..index].iter().flat_map(|b| crossings(a, b)));
        }
        heights.sort_by(f64::total_cmp);
        Self { shape, dimension, outline, heights }
    }

    /// Length or area (m, m2) of the shape within the cell, and its first moment about `center`.
    pub fn clip(&self, center: DVec2, side: f64) -> (f64, DVec2) {
        // In 1D the cell is one unit high, so that area is length.
        let height = if self.dimension == 1 { 1.0 } else { side };
        let (left, right) = (center.x - side / 2.0, center.x + side / 2.0);
        let (low, high) = (center.y - height / 2.0, center.y + height / 2.0);
        let within = |y: &f64| low < *y && *y < high;
        let first = self.heights.partition_point(|y| *y <= low);
        let mut breaks = vec![low, high];
        breaks.extend(self.heights[first..].iter().take_while(|y| within(y)));
        for edge in &self.outline {
            let sides = [left, right].into_iter().flat_map(|x| edge.heights_at(x));
            breaks.extend(sides.filter(within));
        }
        breaks.sort_by(f64::total_cmp);
        let (mut area, mut moment) = (0.0, DVec2::ZERO);
        for slab in breaks.windows(2).filter(|slab| slab[0] < slab[1]) {
            let middle = (slab[0] + slab[1]) / 2.0;
            let (start, end) = (Edge::upright(left), Edge::upright(right));
            let mut inside = spans(self.shape, self.dimension, middle);
            inside.push(Span { start, end });
            for span in covered(inside, 2, middle) {
                let far = span.end.integrate(center, slab[0], slab[1]);
                let near = span.start.integrate(center, slab[0], slab[1]);
                area += far.0 - near.0;
                moment += far.1 - near.1;
            }
        }
        (area, moment)
    }
}
