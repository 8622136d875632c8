//! Charts and maps of a study as SVG and PNG, and a page that holds them.
//!
//! A picture is laid out once, in a list of marks ([`canvas`]), which plotters' backends paint, so that both files show
//! the same. Its letters are those of DejaVu Sans, which the program carries, so that it needs no fonts of the system.

mod axis;
mod canvas;
mod frame;
mod labels;
mod map;
mod page;
mod scale;
mod text;

#[cfg(test)]
mod tests;

pub use axis::{Axis, Style};
pub use page::{Page, Section, Table};

use canvas::Canvas;
use std::path::Path;

/// Width and height of a picture, in CSS pixels; a PNG has twice as many each way.
pub(super) const SIZE: [f64; 2] = [460.0, 370.0];

/// Points that belong together. What is not finite is left out and breaks a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// In the legend; not there where it is empty.
    pub name: String,
    pub style: Style,
    /// A number of the palette, which starts anew after 8.
    pub colour: usize,
    pub points: Vec<[f64; 2]>,
    /// None, or one for each point; an empty one is not written.
    pub labels: Vec<String>,
}

/// Numbers over a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    pub title: String,
    /// Small print below.
    pub note: String,
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<Series>,
}

/// A number over two others, as colours. Its axes are linear and need a range.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    pub title: String,
    /// Small print below.
    pub note: String,
    pub x: Axis,
    pub y: Axis,
    /// Rows from low y to high y, each from low x to high x. What is not finite is left blank.
    pub values: Vec<Vec<f64>>,
    /// What the colours measure, with its unit.
    pub unit: String,
}

/// Something to write as a file or to put on a page.
#[derive(Debug, Clone, PartialEq)]
pub enum Picture {
    Chart(Chart),
    Map(Map),
    /// Side by side in a file, one after the other where a page is narrow.
    Row(Vec<Picture>),
}

impl Picture {
    /// # Errors
    /// What cannot be drawn: a map without values, or rows of unlike length.
    pub fn svg(&self) -> Result<String, String> {
        self.canvas()?.svg()
    }

    /// Writes `stem.svg` and `stem.png`.
    ///
    /// # Errors
    /// As [`Picture::svg`], or the files cannot be written.
    pub fn write(&self, stem: &Path) -> Result<(), String> {
        let canvas = self.canvas()?;
        let (svg, image) = (canvas.svg()?, canvas.image()?);
        if let Some(folder) = stem.parent() {
            std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        // Not `with_extension`: a stem may have a dot of its own.
        let file = |end: &str| stem.with_file_name(format!("{}.{end}", stem.file_name().unwrap_or_default().display()));
        let path = file("svg");
        crate::output::durable::put(&path, &[svg.as_bytes()])?;
        crate::output::save_png(&file("png"), &image)
    }

    /// What it says in one line.
    pub fn title(&self) -> String {
        match self {
            Self::Chart(chart) => chart.title.clone(),
            Self::Map(map) => map.title.clone(),
            Self::Row(parts) => parts.iter().map(Self::title).collect::<Vec<_>>().join("; "),
        }
    }

    /// Its charts and maps.
    fn parts(&self) -> Vec<&Picture> {
        match self {
            Self::Row(parts) => parts.iter().flat_map(Self::parts).collect(),
            one => vec![one],
        }
    }

    fn canvas(&self) -> Result<Canvas, String> {
        match self {
            Self::Chart(chart) => Ok(chart.canvas()),
            Self::Map(map) => map.canvas(),
            Self::Row(_) => {
                let parts = self.parts().into_iter().map(Self::canvas).collect::<Result<Vec<_>, _>>()?;
                Ok(Canvas::beside(parts))
            }
        }
    }
}

impl Chart {
    fn canvas(&self) -> Canvas {
        let mut canvas = Canvas::new(SIZE);
        let shown = |k: usize| self.series.iter().flat_map(move |series| series.points.iter().map(move |point| point[k]));
        let named = self.series.iter().filter(|series| !series.name.is_empty());
        let legend: Vec<frame::Entry> = named.map(|series| (series.name.as_str(), series.colour, series.style)).collect();
        let scales = [scale::Scale::new(&self.x, shown(0)), scale::Scale::new(&self.y, shown(1))];
        let frame = frame::Frame::draw(&mut canvas, [&self.title, &self.note], scales, &legend, 0.0);
        let mut labels = labels::Labels::new(frame.plot);
        for series in &self.series {
            let places: Vec<Option<[f64; 2]>> = series.points.iter().map(|point| frame.place(*point)).collect();
            series.draw(&mut canvas, &places);
            for (k, place) in places.iter().enumerate() {
                if let Some(at) = *place {
                    labels.add(at, series.labels.get(k).map_or("", String::as_str), series.colour, series.style != Style::Line);
                }
            }
        }
        labels.draw(&mut canvas);
        canvas
    }
}

impl Series {
    fn draw(&self, canvas: &mut Canvas, places: &[Option<[f64; 2]>]) {
        let colour = canvas::palette(self.colour);
        if self.style != Style::Points {
            let dashed = self.style == Style::Dashed;
            for run in places.split(Option::is_none).filter(|run| run.len() > 1) {
                canvas.line(run.iter().copied().flatten().collect(), colour, 1.6, dashed);
            }
        }
        if matches!(self.style, Style::Points | Style::LinePoints) {
            places.iter().copied().flatten().for_each(|at| canvas.dot(at, 3.2, colour));
        }
    }
}
