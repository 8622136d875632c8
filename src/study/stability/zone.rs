//! The Brillouin zone of a setting as numbers and as a picture.

use super::Growth;
use super::setting::Setting;
use super::simulate::Measured;
use crate::study::chart::{Axis, Chart, Map, Picture, Series, Style};
use rayon::prelude::*;
use std::collections::HashMap;
use std::f64::consts::PI;

/// Fastest growth rate and least frequency of a wave, over c/dx.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// k dx.
    pub wave: [f64; 3],
    pub rate: f64,
    /// Angular frequency of the wave's slowest motion; 0 where that motion grows.
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

    /// Growth rates and, beside them, the least frequencies; and what runs found, where they are of most waves.
    pub fn picture(&self, name: &str, growth: &Growth, setting: &Setting, runs: &[&Measured]) -> Picture {
        let fastest = growth.mode.rate / setting.unit_rate();
        let wave = growth.wave[..setting.dimension()].iter().map(|k| format!("{:.2}", k * setting.spacing() / PI));
        let place = wave.collect::<Vec<_>>().join(", ");
        let note = match fastest > 0.0 {
            true => format!("{name}: largest {fastest:.4} c/dx at k dx/pi = ({place})"),
            false => format!("{name}: no wave grows"),
        };
        if setting.dimension() == 1 {
            return self.chart(note, runs);
        }
        let slice = if setting.dimension() == 3 { ", kz = 0" } else { "" };
        let map = |title: &str, note: &str, unit: &str, of: &dyn Fn(&Sample) -> f64| {
            // Half a cell beyond the edges.
            let end = ((self.cells / 2) as f64 + 0.5) * 2.0 / self.cells as f64;
            let axis = |label: &str| Axis::linear(label).within([-end, end]);
            let values = self.rows.iter().map(|row| row.iter().map(of).collect()).collect();
            let (title, note) = (format!("{title}{slice}"), note.to_string());
            Picture::Map(Map { title, note, x: axis("kx dx/pi"), y: axis("ky dx/pi"), values, unit: unit.into() })
        };
        let mut maps = vec![
            map("Growth rate of plane waves", &note, "c/dx", &|sample| sample.rate),
            map("Frequency of the slowest motion", "0 where a wave grows", "c/dx", &|sample| sample.frequency),
        ];
        let known: HashMap<[i64; 3], &Measured> =
            runs.iter().flat_map(|run| self.places(run.wave).map(|place| (place, *run))).collect();
        let found = |sample: &Sample| known.get(&self.places(sample.wave)[0]).copied();
        let all = self.rows.iter().flatten();
        if 2 * all.clone().filter(|sample| found(sample).is_some()).count() > all.count() {
            let rate = |sample: &Sample| found(sample).map_or(f64::NAN, |run| run.rate);
            let difference = |sample: &Sample| found(sample).map_or(f64::NAN, |run| 100.0 * run.difference.abs());
            maps.push(map("Growth rate in runs", "", "c/dx", &rate));
            maps.push(map(
                "Difference of runs and theory",
                "of growth rates, or of frequencies where waves swing",
                "%",
                &difference,
            ));
        }
        Picture::Row(maps)
    }

    /// The wave in whole numbers within the zone, and the opposite wave, which is the same motion.
    fn places(&self, wave: [f64; 3]) -> [[i64; 3]; 2] {
        let cells = self.cells as i64;
        let number = |k: f64| (k * self.cells as f64 / (2.0 * PI)).round() as i64;
        [1, -1].map(|sign| wave.map(|k| (sign * number(k)).rem_euclid(cells)))
    }

    fn chart(&self, note: String, runs: &[&Measured]) -> Picture {
        let series = |name: &str, style: Style, colour: usize, points: Vec<[f64; 2]>| Series {
            name: name.into(),
            style,
            colour,
            points,
            labels: Vec::new(),
        };
        let right = || self.rows[0].iter().filter(|sample| sample.wave[0] > 0.0);
        let mut all = vec![
            series("growth rate", Style::Line, 1, right().map(|s| [s.wave[0] / PI, s.rate]).collect()),
            series("frequency", Style::Line, 0, right().map(|s| [s.wave[0] / PI, s.frequency]).collect()),
        ];
        let of = |grows: bool| runs.iter().filter(move |run| (run.theory.rate > 0.0) == grows);
        let rates: Vec<_> = of(true).map(|run| [run.wave[0].abs() / PI, run.rate]).collect();
        let frequencies: Vec<_> = of(false).map(|run| [run.wave[0].abs() / PI, run.frequency]).collect();
        all.extend((!rates.is_empty()).then(|| series("growth rate in runs", Style::Points, 1, rates)));
        all.extend((!frequencies.is_empty()).then(|| series("frequency in runs", Style::Points, 0, frequencies)));
        Picture::Chart(Chart {
            title: "Growth rate and frequency of plane waves".into(),
            note,
            x: Axis::linear("k dx/pi"),
            y: Axis::linear("rate or frequency, c/dx"),
            series: all,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opposite_waves_and_both_edges_of_the_zone_have_one_place() {
        let zone = Zone { cells: 12, rows: Vec::new() };
        let wave = |x: i64, y: i64| [x, y, 0].map(|number| number as f64 * PI / 6.0);
        assert_eq!(zone.places(wave(6, 1)), [[6, 1, 0], [6, 11, 0]]);
        assert_eq!(zone.places(wave(-6, 1))[0], zone.places(wave(6, 1))[0]);
        assert_eq!(zone.places(wave(-2, 3))[1], zone.places(wave(2, -3))[0]);
    }
}
