//! Short forms of the charts' parts.

use crate::study::chart::{Axis, Chart, Picture, Series, Style};

pub fn curve(name: impl Into<String>, colour: usize, points: Vec<[f64; 2]>) -> Series {
    Series { name: name.into(), style: Style::Line, colour, points, labels: Vec::new() }
}

pub fn dashed(name: impl Into<String>, colour: usize, points: Vec<[f64; 2]>) -> Series {
    Series { style: Style::Dashed, ..curve(name, colour, points) }
}

pub fn dots(name: impl Into<String>, colour: usize, points: Vec<[f64; 2]>, labels: Vec<String>) -> Series {
    Series { style: Style::Points, labels, ..curve(name, colour, points) }
}

pub fn chart(title: &str, note: &str, x: Axis, y: Axis, series: Vec<Series>) -> Picture {
    Picture::Chart(Chart { title: title.into(), note: note.into(), x, y, series })
}
