//! What surrounds the particles: title, axes or triad, colour bar and caption.

use super::axis::{Axis, named, quantity};
use super::colour::ColourScale;
use super::ink::{Colour, INK, PALE_INK, behind, fill, stroke, text, width};
use super::picture::View;
use super::snapshot::Snapshot;
use image::RgbaImage;

const RULE: Colour = [0.72, 0.74, 0.77];

/// Edges in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

/// Where everything goes and what it says.
#[derive(Debug, Clone)]
pub struct Layout {
    /// Pixels along each side of a dot of the 8 x 8 font.
    pub scale: i32,
    pub plot: Rectangle,
    pub axes: Option<[Axis; 2]>,
    pub triad: Option<[[f64; 2]; 3]>,
    bar: Option<(ColourScale, Axis)>,
    field: String,
    unit: String,
    length: String,
    caption: String,
}

impl Layout {
    /// `labels` is the room for numbers on the left, in letters; none means no axes.
    pub fn new(view: &View, snapshot: &Snapshot, labels: i32, bar: Option<(ColourScale, Axis)>) -> Self {
        let [width, height] = [view.width as i32, view.height as i32];
        let scale = ((width.min(height * 4 / 3) + 200) / 500).max(1);
        let letter = 8 * scale;
        // Room for the six letters of "-999.5", so that the plot keeps its place as the range moves.
        let right = bar.as_ref().map_or(2 * letter, |(_, axis)| letter * (axis.longest().max(6) as i32 + 5));
        let below = if labels > 0 { 6 * letter } else { 7 * letter / 2 };
        // Small pictures keep at least a quarter of each side for the particles.
        let left = ((labels + 1) * letter).min(width / 3);
        let plot = Rectangle {
            left,
            top: 3 * letter,
            right: (width - right).max(left + width / 4),
            bottom: (height - below).max(3 * letter + height / 4),
        };
        let (length, time) = snapshot.length_and_time_unit();
        let moment = format!("t = {}   step {}", quantity(snapshot.time, time), snapshot.step);
        Self {
            scale,
            plot,
            axes: None,
            triad: None,
            bar,
            field: view.field.clone(),
            unit: snapshot.unit(&view.field).into(),
            length: length.into(),
            caption: format!("{}   {moment}", view.caption).trim_start().to_string(),
        }
    }

    fn letter(&self) -> i32 {
        8 * self.scale
    }
}

/// Draws the surroundings onto a picture whose plot is filled already.
pub fn draw(image: &mut RgbaImage, layout: &Layout) {
    let letter = layout.letter();
    if let Some(axes) = &layout.axes {
        draw_axes(image, layout, axes);
    }
    if let Some(directions) = layout.triad {
        draw_triad(image, layout, directions);
    }
    if let Some((scale, axis)) = &layout.bar {
        draw_bar(image, layout, scale, axis);
        let title = named(&layout.field, &layout.unit, axis.power);
        let right = image.width() as i32 - letter;
        text(image, [right - width(&title, layout.scale), letter], layout.scale, INK, &title);
    }
    let bottom = image.height() as i32 - 2 * letter;
    text(image, [letter, bottom], layout.scale, INK, &layout.caption);
}

fn draw_bar(image: &mut RgbaImage, layout: &Layout, scale: &ColourScale, axis: &Axis) {
    let (letter, plot) = (layout.letter(), layout.plot);
    let [left, right] = [plot.right + letter, plot.right + 5 * letter / 2];
    let [low, high] = axis.range;
    for y in plot.top..plot.bottom {
        let part = f64::from(plot.bottom - y) / f64::from(plot.bottom - plot.top);
        fill(image, [left, y, right, y + 1], scale.srgb(low + part * (high - low)));
    }
    frame(image, Rectangle { left, right, ..plot }, layout.scale.min(2) / 2 + 1);
    for &tick in &axis.ticks {
        let y = plot.bottom - (axis.part(tick) * f64::from(plot.bottom - plot.top)).round() as i32;
        fill(image, [right, y, right + letter / 2, y + layout.scale.min(2)], INK);
        text(image, [right + letter, y - letter / 2 + 1], layout.scale, INK, &axis.label(tick));
    }
}

/// Frame, ticks and numbers; grid lines lie only where no particle is.
fn draw_axes(image: &mut RgbaImage, layout: &Layout, [across, up]: &[Axis; 2]) {
    let (letter, plot, thick) = (layout.letter(), layout.plot, layout.scale.min(2));
    for &tick in &across.ticks {
        let x = plot.left + (across.part(tick) * f64::from(plot.right - plot.left)).round() as i32;
        behind(image, [x, plot.top, x + 1, plot.bottom]);
        fill(image, [x, plot.bottom, x + thick, plot.bottom + letter / 2], INK);
        let label = across.label(tick);
        text(image, [x - width(&label, layout.scale) / 2, plot.bottom + letter], layout.scale, INK, &label);
    }
    for &tick in &up.ticks {
        let y = plot.bottom - (up.part(tick) * f64::from(plot.bottom - plot.top)).round() as i32;
        behind(image, [plot.left, y, plot.right, y + 1]);
        fill(image, [plot.left - letter / 2, y, plot.left, y + thick], INK);
        let label = up.label(tick);
        let x = plot.left - letter - width(&label, layout.scale);
        text(image, [x, y - letter / 2 + 1], layout.scale, INK, &label);
    }
    frame(image, plot, thick);
    let name = named("x", &layout.length, across.power);
    text(image, [plot.right - width(&name, layout.scale), plot.bottom + 5 * letter / 2], layout.scale, INK, &name);
    let name = match layout.bar {
        Some(_) => named("y", &layout.length, up.power),
        None => named(&layout.field, &layout.unit, up.power),
    };
    text(image, [plot.left, letter], layout.scale, INK, &name);
}

fn draw_triad(image: &mut RgbaImage, layout: &Layout, directions: [[f64; 2]; 3]) {
    let letter = f64::from(layout.letter());
    let from = [f64::from(layout.plot.left) + 3.5 * letter, f64::from(layout.plot.bottom) - 3.0 * letter];
    for ([right, up], name) in directions.into_iter().zip(["x", "y", "z"]) {
        let at = |length: f64| [from[0] + length * letter * right, from[1] - length * letter * up];
        stroke(image, from, at(2.2), 0.4 * f64::from(layout.scale) + 0.4);
        // An axis towards the eye has no room for its name.
        if right.hypot(up) > 0.2 {
            let corner = at(2.9).map(|v| (v - 0.5 * letter).round() as i32);
            text(image, corner, layout.scale, PALE_INK, name);
        }
    }
}

fn frame(image: &mut RgbaImage, Rectangle { left, top, right, bottom }: Rectangle, thick: i32) {
    fill(image, [left - thick, top - thick, right + thick, top], RULE);
    fill(image, [left - thick, bottom, right + thick, bottom + thick], RULE);
    fill(image, [left - thick, top, left, bottom], RULE);
    fill(image, [right, top, right + thick, bottom], RULE);
}
