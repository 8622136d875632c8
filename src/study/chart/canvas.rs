//! A list of marks, and its painting by plotters.

use image::{RgbImage, RgbaImage, imageops};
use plotters::coord::Shift;
use plotters::prelude::{
    BitMapBackend, Circle, DrawingArea, DrawingBackend, FontStyle, FontTransform, IntoDrawingArea, IntoFont, PathElement,
    RGBColor, Rectangle, SVGBackend, Text,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, register_font};
use std::sync::Once;

pub type Colour = [u8; 3];
pub const INK: Colour = [33, 36, 41];
pub const PALE_INK: Colour = [92, 98, 106];
pub const GRID: Colour = [228, 231, 234];

/// Colours that people with any colour vision tell apart: Okabe & Ito 2008, without yellow, which paper swallows.
const PALETTE: [Colour; 8] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [120, 94, 60], [33, 36, 41]];

pub fn palette(number: usize) -> Colour {
    PALETTE[number % PALETTE.len()]
}

/// Backends count in whole pixels: so many to a CSS pixel keep curves smooth.
const FINE: f64 = 4.0;
/// Pixels of a PNG to a CSS pixel.
const DENSE: f64 = 2.0;
/// Plotters takes the height of a line for the size of its letters.
const LINE_HEIGHT: f64 = 1.24;
/// Its bitmaps centre a line with its descenders, its SVG the letters without: what brings both to one level, in sizes.
const SINK: f64 = 0.15;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    Left,
    Center,
    Right,
    /// Read from below, centred.
    Upward,
}

#[derive(Debug, Clone)]
enum Mark {
    Line { points: Vec<[f64; 2]>, colour: Colour, width: f64 },
    Dot { at: [f64; 2], radius: f64, colour: Colour },
    Block { corners: [[f64; 2]; 2], colour: Colour },
    Text { at: [f64; 2], text: String, size: f64, colour: Colour, align: Align, bold: bool },
}

/// Marks in CSS pixels from the upper left, the later over the earlier.
#[derive(Debug, Clone)]
pub struct Canvas {
    pub size: [f64; 2],
    marks: Vec<Mark>,
}

/// Width of a text in pixels, in regular letters.
pub fn width(text: &str, size: f64) -> f64 {
    fonts();
    // Measured large, since the answer comes in whole pixels.
    let font = ("sans-serif", 10.0 * size * LINE_HEIGHT).into_font();
    font.box_size(text).map_or(0.0, |(width, _)| f64::from(width) / 10.0)
}

fn fonts() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // Both are fonts: the crate's own tests read them.
        let _ = register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular());
        let _ = register_font("sans-serif", FontStyle::Bold, dejavu::sans::bold());
    });
}

impl Canvas {
    pub fn new(size: [f64; 2]) -> Self {
        Self { size, marks: Vec::new() }
    }

    /// One beside the other, as high as the highest.
    pub fn beside(parts: Vec<Canvas>) -> Self {
        let mut row = Self::new([0.0; 2]);
        for part in parts {
            let shift = row.size[0];
            row.marks.extend(part.marks.into_iter().map(|mark| mark.shifted(shift)));
            row.size = [shift + part.size[0], row.size[1].max(part.size[1])];
        }
        row
    }

    pub fn line(&mut self, points: Vec<[f64; 2]>, colour: Colour, width: f64, dashed: bool) {
        let lines = if dashed { dashes(&points) } else { vec![points] };
        self.marks.extend(lines.into_iter().map(|points| Mark::Line { points, colour, width }));
    }
    pub fn dot(&mut self, at: [f64; 2], radius: f64, colour: Colour) {
        self.marks.push(Mark::Dot { at, radius, colour });
    }
    /// A filled box from its upper left to its lower right.
    pub fn block(&mut self, corners: [[f64; 2]; 2], colour: Colour) {
        self.marks.push(Mark::Block { corners, colour });
    }
    /// `at` is half way up the letters.
    pub fn text(&mut self, text: &str, at: [f64; 2], size: f64, colour: Colour, align: Align, bold: bool) {
        self.marks.push(Mark::Text { at, text: text.into(), size, colour, align, bold });
    }

    /// # Errors
    /// The backend's.
    pub fn svg(&self) -> Result<String, String> {
        let [wide, high] = self.fine();
        let mut text = String::new();
        self.paint(&SVGBackend::with_string(&mut text, (wide, high)).into_drawing_area(), 0.0)?;
        let (fine, size) = (format!("<svg width=\"{wide}\" height=\"{high}\""), self.size);
        Ok(text.replacen(&fine, &format!("<svg width=\"{}\" height=\"{}\"", size[0], size[1]), 1))
    }

    /// # Errors
    /// The backend's.
    pub fn image(&self) -> Result<RgbaImage, String> {
        let [wide, high] = self.fine();
        let mut pixels = vec![0; 3 * wide as usize * high as usize];
        self.paint(&BitMapBackend::with_buffer(&mut pixels, (wide, high)).into_drawing_area(), SINK)?;
        let fine = RgbImage::from_raw(wide, high, pixels).ok_or("a picture of another size than its pixels")?;
        let dense = |pixels: u32| (f64::from(pixels) / FINE * DENSE) as u32;
        let shrunk = imageops::resize(&fine, dense(wide), dense(high), imageops::FilterType::Triangle);
        Ok(RgbaImage::from_fn(shrunk.width(), shrunk.height(), |x, y| {
            let [red, green, blue] = shrunk.get_pixel(x, y).0;
            image::Rgba([red, green, blue, 255])
        }))
    }

    fn fine(&self) -> [u32; 2] {
        self.size.map(|side| (side * FINE).round() as u32)
    }

    fn paint<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, sink: f64) -> Result<(), String> {
        fonts();
        let wrong = |error| format!("cannot draw: {error:?}");
        area.fill(&RGBColor(255, 255, 255)).map_err(|error| format!("cannot draw: {error:?}"))?;
        for mark in &self.marks {
            mark.paint(area, sink).map_err(wrong)?;
        }
        area.present().map_err(|error| format!("cannot draw: {error:?}"))
    }
}

type Drawn<B> = Result<(), plotters::drawing::DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

impl Mark {
    fn shifted(mut self, right: f64) -> Self {
        match &mut self {
            Self::Line { points, .. } => points.iter_mut().for_each(|point| point[0] += right),
            Self::Dot { at, .. } | Self::Text { at, .. } => at[0] += right,
            Self::Block { corners, .. } => corners.iter_mut().for_each(|corner| corner[0] += right),
        }
        self
    }

    fn paint<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, sink: f64) -> Drawn<B> {
        let pixel = |[x, y]: [f64; 2]| ((x * FINE).round() as i32, (y * FINE).round() as i32);
        match self {
            Self::Line { points, colour, width } => {
                let style = rgb(*colour).stroke_width((width * FINE).round() as u32);
                area.draw(&PathElement::new(points.iter().map(|&point| pixel(point)).collect::<Vec<_>>(), style))
            }
            Self::Dot { at, radius, colour } => {
                area.draw(&Circle::new(pixel(*at), (radius * FINE).round() as i32, rgb(*colour).filled()))
            }
            Self::Block { corners, colour } => area.draw(&Rectangle::new(corners.map(pixel), rgb(*colour).filled())),
            Self::Text { at, text, size, colour, align, bold } => {
                let style = if *bold { FontStyle::Bold } else { FontStyle::Normal };
                let mut font = ("sans-serif", size * LINE_HEIGHT * FINE, style).into_font();
                if *align == Align::Upward {
                    font = font.transform(FontTransform::Rotate270);
                }
                let across = match align {
                    Align::Left => HPos::Left,
                    Align::Right => HPos::Right,
                    Align::Center | Align::Upward => HPos::Center,
                };
                let style = font.color(&rgb(*colour)).pos(Pos::new(across, VPos::Center));
                let sink = sink * size;
                let at = if *align == Align::Upward { [at[0] + sink, at[1]] } else { [at[0], at[1] + sink] };
                area.draw(&Text::new(text.as_str(), pixel(at), style))
            }
        }
    }
}

fn rgb([red, green, blue]: Colour) -> RGBColor {
    RGBColor(red, green, blue)
}

/// A line in strokes of 5 pixels with 4 between them.
fn dashes(points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    const LENGTH: [f64; 2] = [5.0, 4.0];
    let (mut strokes, mut stroke) = (Vec::new(), points.first().map_or_else(Vec::new, |&first| vec![first]));
    let (mut gap, mut left) = (0, LENGTH[0]);
    for ends in points.windows(2) {
        let ([from, to], mut done) = ([ends[0], ends[1]], 0.0);
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        while length - done > left {
            done += left;
            let part = done / length;
            let turn = [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
            if gap == 0 {
                stroke.push(turn);
                strokes.push(std::mem::take(&mut stroke));
            } else {
                stroke = vec![turn];
            }
            (gap, left) = (1 - gap, LENGTH[1 - gap]);
        }
        left -= length - done;
        if gap == 0 {
            stroke.push(to);
        }
    }
    strokes.push(stroke);
    strokes.retain(|stroke| stroke.len() > 1);
    strokes
}

#[cfg(test)]
impl Canvas {
    /// Areas of the texts that begin at their place.
    pub fn texts(&self) -> Vec<[f64; 4]> {
        let area = |mark: &Mark| match mark {
            Mark::Text { at: [x, y], text, size, align: Align::Left, .. } => {
                Some([*x, y - 0.5 * size, x + width(text, *size), y + 0.5 * size])
            }
            _ => None,
        };
        self.marks.iter().filter_map(area).collect()
    }
}
