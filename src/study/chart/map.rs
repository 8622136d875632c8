//! A number over two others, as colours.

use super::canvas::{Align, Canvas, Colour, INK};
use super::frame::{Frame, SMALL};
use super::scale::Scale;
use super::{Axis, Map, SIZE};
use crate::output::colour::ColourScale;

/// Colours of the bar, and of the map: cells of one colour side by side are one box.
const STEPS: usize = 128;
/// Room for the bar of colours with its numbers.
const ASIDE: f64 = 84.0;

impl Map {
    pub(super) fn canvas(&self) -> Result<Canvas, String> {
        let columns = self.values.first().map_or(0, Vec::len);
        if columns == 0 || self.values.iter().any(|row| row.len() != columns) {
            return Err(format!("the map {:?} needs rows of one length", self.title));
        }
        if self.x.range.is_none() || self.y.range.is_none() {
            return Err(format!("the map {:?} needs the ranges of its axes", self.title));
        }
        let mut canvas = Canvas::new(SIZE);
        let scales = [Scale::new(&self.x, std::iter::empty()), Scale::new(&self.y, std::iter::empty())];
        let frame = Frame::draw(&mut canvas, [&self.title, &self.note], scales, &[], ASIDE);
        let colours = self.colours();
        let [left, top, right, bottom] = frame.plot;
        let (wide, high) = ((right - left) / columns as f64, (bottom - top) / self.values.len() as f64);
        for (row, values) in self.values.iter().enumerate() {
            let steps: Vec<Option<usize>> = values.iter().map(|&value| step(value, colours.range)).collect();
            let mut begin = 0;
            for run in steps.chunk_by(|a, b| a == b) {
                let end = begin + run.len();
                let (low, from, to) = (bottom - row as f64 * high, left + begin as f64 * wide, left + end as f64 * wide);
                if let Some(step) = run[0] {
                    canvas.block([[from, low - high], [to, low]], colour(step, colours));
                }
                begin = end;
            }
        }
        self.draw_bar(&mut canvas, [right + 14.0, top, right + 28.0, bottom], colours);
        Ok(canvas)
    }

    /// From zero, or the least, to the largest.
    fn colours(&self) -> ColourScale {
        let finite = self.values.iter().flatten().copied().filter(|value| value.is_finite());
        let [low, high] = finite.fold([0.0f64; 2], |[low, high], value| [low.min(value), high.max(value)]);
        ColourScale::new(if high > low { [low, high] } else { [0.0, 1.0] })
    }

    fn draw_bar(&self, canvas: &mut Canvas, [left, top, right, bottom]: [f64; 4], colours: ColourScale) {
        let high = (bottom - top) / STEPS as f64;
        for step in 0..STEPS {
            let low = bottom - step as f64 * high;
            canvas.block([[left, low - high], [right, low]], colour(step, colours));
        }
        let scale = Scale::new(&Axis::linear(self.unit.clone()).within(colours.range), std::iter::empty());
        for (value, text) in &scale.ticks {
            if let Some(part) = scale.part(*value) {
                let at = bottom - part * (bottom - top);
                canvas.line(vec![[right, at], [right + 3.0, at]], INK, 1.0, false);
                canvas.text(text, [right + 6.0, at], SMALL, INK, Align::Left, false);
            }
        }
        canvas.text(&scale.label, [right + 48.0, 0.5 * (top + bottom)], SMALL, INK, Align::Upward, false);
    }
}

fn step(value: f64, [low, high]: [f64; 2]) -> Option<usize> {
    value.is_finite().then(|| (((value - low) / (high - low) * STEPS as f64) as usize).min(STEPS - 1))
}

fn colour(step: usize, scale: ColourScale) -> Colour {
    let [low, high] = scale.range;
    let value = low + (step as f64 + 0.5) / STEPS as f64 * (high - low);
    scale.srgb(value).map(|channel| (255.0 * channel).round() as u8)
}
