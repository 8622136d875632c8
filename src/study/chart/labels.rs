//! Names beside points, where they hide neither each other nor a point.

use super::canvas::{self, Align, Canvas, Colour, PALE_INK};
use super::frame::SMALL;

const SIZE: f64 = SMALL - 1.0;
/// Distances from the point that are tried, in pixels.
const REACH: [f64; 5] = [8.0, 16.0, 28.0, 44.0, 64.0];

pub struct Labels {
    /// Left, top, right, bottom.
    plot: [f64; 4],
    names: Vec<([f64; 2], String, Colour)>,
    points: Vec<[f64; 2]>,
}

impl Labels {
    pub fn new(plot: [f64; 4]) -> Self {
        Self { plot, names: Vec::new(), points: Vec::new() }
    }

    /// A point, seen where it has a dot, and its name, which may be empty.
    pub fn add(&mut self, at: [f64; 2], name: &str, colour: usize, dot: bool) {
        if dot {
            self.points.push(at);
        }
        if !name.is_empty() {
            self.names.push((at, name.into(), canvas::palette(colour)));
        }
    }

    pub fn draw(&self, canvas: &mut Canvas) {
        let mut taken: Vec<[f64; 4]> = Vec::new();
        for (at, name, colour) in &self.names {
            let wide = canvas::width(name, SIZE);
            let candidates = REACH.iter().flat_map(|&reach| around(*at, wide, reach));
            // The nearer come first and win where others are no better.
            let hidden = |area: &[f64; 4]| self.hidden(area, &taken);
            let best = candidates.map(|area| (hidden(&area), area)).min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, area)) = best else { continue };
            let nearest = [at[0].clamp(area[0], area[2]), at[1].clamp(area[1], area[3])];
            if (nearest[0] - at[0]).hypot(nearest[1] - at[1]) > 1.5 * REACH[0] {
                canvas.line(vec![*at, nearest], PALE_INK, 0.6, false);
            }
            canvas.text(name, [area[0], 0.5 * (area[1] + area[3])], SIZE, *colour, Align::Left, false);
            taken.push(area);
        }
    }

    /// How much a name here would hide or lose, in pixels and points.
    fn hidden(&self, area: &[f64; 4], taken: &[[f64; 4]]) -> f64 {
        let [left, top, right, bottom] = *area;
        let beyond = (self.plot[0] - left).max(0.0) + (right - self.plot[2]).max(0.0);
        let over = (self.plot[1] - top).max(0.0) + (bottom - self.plot[3]).max(0.0);
        let shared = |other: &[f64; 4]| {
            (right.min(other[2]) - left.max(other[0])).max(0.0) * (bottom.min(other[3]) - top.max(other[1])).max(0.0)
        };
        let dots =
            self.points.iter().filter(|p| p[0] > left - 3.0 && p[0] < right + 3.0 && p[1] > top - 2.0 && p[1] < bottom + 2.0);
        40.0 * (beyond + over) + taken.iter().map(shared).sum::<f64>() + 25.0 * dots.count() as f64
    }
}

/// Areas for a text of this width round a point, to the right first.
fn around([x, y]: [f64; 2], wide: f64, reach: f64) -> impl Iterator<Item = [f64; 4]> {
    let half = 0.6 * SIZE;
    const SIDES: [[f64; 2]; 8] =
        [[1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [-1.0, 1.0], [1.0, 0.0], [-1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];
    SIDES.into_iter().map(move |[across, down]| {
        let slant = if across != 0.0 && down != 0.0 { 0.7 * reach } else { reach };
        let middle = x + across * (slant + 0.5 * wide);
        let level = y + down * (slant + if across == 0.0 { half } else { 0.3 * half });
        [middle - 0.5 * wide, level - half, middle + 0.5 * wide, level + half]
    })
}
