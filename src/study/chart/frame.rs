//! What stands around what is shown: title, legend, axes, small print.

use super::axis::Style;
use super::canvas::{self, Align, Canvas, GRID, INK, PALE_INK};
use super::scale::Scale;
use super::text::{paragraph, wrapped};

const TITLE: f64 = 15.0;
const LABEL: f64 = 13.0;
pub const SMALL: f64 = 12.0;
const EDGE: f64 = 14.0;

/// Name, colour and style of a series.
pub type Entry<'a> = (&'a str, usize, Style);

/// The area of the plot, and how numbers lie in it.
pub struct Frame {
    /// Left, top, right, bottom.
    pub plot: [f64; 4],
    scales: [Scale; 2],
}

impl Frame {
    /// Draws all but what is shown; `aside` pixels are kept free on the right.
    pub fn draw(canvas: &mut Canvas, [title, note]: [&str; 2], scales: [Scale; 2], legend: &[Entry], aside: f64) -> Self {
        let [wide, high] = canvas.size;
        let inner = wide - 2.0 * EDGE;
        // Bold letters are a tenth wider.
        let mut top = paragraph(canvas, &wrapped(title, TITLE, inner / 1.12), [EDGE, 10.0], TITLE, true);
        top = draw_legend(canvas, legend, [EDGE, top + 4.0], inner);
        let notes = wrapped(note, SMALL, inner);
        let below = high - 8.0 - 1.3 * SMALL * notes.len() as f64;
        paragraph(canvas, &notes, [EDGE, below], SMALL, false);
        let widest = scales[1].ticks.iter().map(|(_, text)| canvas::width(text, SMALL)).fold(0.0, f64::max);
        let left = EDGE + 1.4 * LABEL + widest + 8.0;
        let bottom = below - 8.0 - 1.3 * LABEL - 1.4 * SMALL;
        let frame = Self { plot: [left, top + 8.0, wide - EDGE - 6.0 - aside, bottom], scales };
        frame.draw_axes(canvas);
        frame
    }

    /// Where a point lies in pixels, where it does.
    pub fn place(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let [left, top, right, bottom] = self.plot;
        let (across, up) = (self.scales[0].part(x)?, self.scales[1].part(y)?);
        Some([left + across * (right - left), bottom - up * (bottom - top)])
    }

    fn draw_axes(&self, canvas: &mut Canvas) {
        let [left, top, right, bottom] = self.plot;
        let [x, y] = &self.scales;
        let mut free = f64::NEG_INFINITY;
        for (value, text) in &x.ticks {
            let Some(at) = x.part(*value).map(|part| left + part * (right - left)) else { continue };
            let half = 0.5 * canvas::width(text, SMALL);
            let fits = !text.is_empty() && at - half > free;
            canvas.line(vec![[at, top], [at, bottom]], GRID, if fits { 1.0 } else { 0.5 }, false);
            if fits {
                free = at + half + 4.0;
                canvas.text(text, [at, bottom + 0.9 * SMALL], SMALL, INK, Align::Center, false);
            }
        }
        for (value, text) in &y.ticks {
            let Some(at) = y.part(*value).map(|part| bottom - part * (bottom - top)) else { continue };
            canvas.line(vec![[left, at], [right, at]], GRID, if text.is_empty() { 0.5 } else { 1.0 }, false);
            canvas.text(text, [left - 6.0, at], SMALL, INK, Align::Right, false);
        }
        canvas.line(vec![[left, top], [left, bottom], [right, bottom]], PALE_INK, 1.0, false);
        let below = bottom + 1.6 * SMALL + 0.7 * LABEL;
        canvas.text(&x.label, [0.5 * (left + right), below], LABEL, INK, Align::Center, false);
        canvas.text(&y.label, [EDGE + 0.5 * LABEL, 0.5 * (top + bottom)], LABEL, INK, Align::Upward, false);
    }
}

/// Draws the names of the series in as many lines as they need; gives where these end.
fn draw_legend(canvas: &mut Canvas, legend: &[Entry], [left, top]: [f64; 2], inner: f64) -> f64 {
    if legend.is_empty() {
        return top;
    }
    let (mut x, mut y) = (left, top + 0.7 * SMALL);
    for &(name, colour, style) in legend {
        let wide = 22.0 + canvas::width(name, SMALL) + 14.0;
        if x > left && x + wide > left + inner {
            (x, y) = (left, y + 1.4 * SMALL);
        }
        let colour = canvas::palette(colour);
        if style != Style::Points {
            canvas.line(vec![[x, y], [x + 16.0, y]], colour, 1.6, style == Style::Dashed);
        }
        if matches!(style, Style::Points | Style::LinePoints) {
            canvas.dot([x + 8.0, y], 3.2, colour);
        }
        canvas.text(name, [x + 22.0, y], SMALL, INK, Align::Left, false);
        x += wide;
    }
    y + 0.7 * SMALL
}
