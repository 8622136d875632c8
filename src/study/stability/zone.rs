//! The Brillouin zone of a setting as numbers and as a picture.

use super::Growth;
use super::setting::Setting;
use crate::study::chart::{Axis, Chart, Map, Picture, Series, Style};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Fastest growth rate and least frequency of a wave, over c/dx.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// k dx.
    pub wave: [f64; 3],
    pub rate: f64,
    /// Of the wave's slowest motion; 0 where that grows.
    pub frequency: f64,
}

/// The whole zone in the plane kz = 0, or along the line; rows from low ky to high ky.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    cells: usize,
    pub rows: Vec<Vec<Sample>>,
}

impl Zone {
    /// Of the waves of a periodic box with so many particles a side, edges of the zone on both sides where that is even.
    pub fn new(setting: &Setting, cells: usize) -> Self {
        let half = (cells / 2) as i64;
        let across = if setting.dimension() == 1 { 0 } else { half };
        let phase = |number: i64| 2.0 * PI * number as f64 / cells as f64;
        let sample = |x: i64, y: i64| {
            let wave = [phase(x), phase(y), 0.0];
            let mode = setting.mode(wave.map(|k| k / setting.spacing()));
            let unit = setting.unit_rate();
            // A wave without an end moves the body as a whole.
            let whole = x == 0 && y == 0;
            let frequency = if whole { f64::NAN } else { mode.frequency / unit };
            Sample { wave, rate: if whole { f64::NAN } else { mode.rate / unit }, frequency }
        };
        let row = |y: i64| (-half..=half).map(|x| sample(x, y)).collect();
        Self { cells, rows: (-across..=across).into_par_iter().map(row).collect() }
    }

    /// Growth rates and, beside them, the least frequencies.
    pub fn picture(&self, name: &str, growth: &Growth, setting: &Setting) -> Picture {
        let fastest = growth.mode.rate / setting.unit_rate();
        let wave = growth.wave[..setting.dimension()].iter().map(|k| format!("{:.2}", k * setting.spacing() / PI));
        let place = wave.collect::<Vec<_>>().join(", ");
        let note = match fastest > 0.0 {
            true => format!("{name}: largest {fastest:.4} c/dx at k dx/pi = ({place})"),
            false => format!("{name}: no wave grows"),
        };
        if setting.dimension() == 1 {
            return self.chart(note);
        }
        let slice = if setting.dimension() == 3 { ", kz = 0" } else { "" };
        let map = |title: &str, note: String, of: fn(&Sample) -> f64| {
            // Half a cell beyond the edges.
            let end = ((self.cells / 2) as f64 + 0.5) * 2.0 / self.cells as f64;
            let axis = |label: &str| Axis::linear(label).within([-end, end]);
            let values = self.rows.iter().map(|row| row.iter().map(of).collect()).collect();
            let title = format!("{title}{slice}");
            Picture::Map(Map { title, note, x: axis("kx dx/pi"), y: axis("ky dx/pi"), values, unit: "c/dx".into() })
        };
        let growth = map("Growth rate of plane waves", note, |sample| sample.rate);
        let slowest = map("Frequency of the slowest motion", "0 where a wave grows".into(), |sample| sample.frequency);
        Picture::Row(vec![growth, slowest])
    }

    fn chart(&self, note: String) -> Picture {
        let series = |name: &str, colour: usize, of: fn(&Sample) -> f64| {
            let right = self.rows[0].iter().filter(|sample| sample.wave[0] > 0.0);
            let points = right.map(|sample| [sample.wave[0] / PI, of(sample)]).collect();
            Series { name: name.into(), style: Style::LinePoints, colour, points, labels: Vec::new() }
        };
        Picture::Chart(Chart {
            title: "Growth rate and frequency of plane waves".into(),
            note,
            x: Axis::linear("k dx/pi"),
            y: Axis::linear("rate or frequency, c/dx"),
            series: vec![series("growth rate", 1, |s| s.rate), series("frequency", 0, |s| s.frequency)],
        })
    }
}
