//! A study as pictures and as a page: every run by its cost and its error, and the front.

use super::front::{Best, best};
use super::measure::Measures;
use super::names::Names;
use super::report::{goals, settings};
use super::row::{Cost, Row};
use crate::study::chart::{Axis, Chart, Page, Picture, Section, Series, Style, Table};
use std::path::Path;

/// Costs that each have a chart.
const CHARTED: [Cost; 2] = [Cost::ParticleUpdates, Cost::CpuSeconds];

/// What the pictures and the page tell of.
#[derive(Clone, Copy)]
pub struct Told<'a> {
    pub title: &'a str,
    pub paths: &'a [String],
    pub measures: &'a Measures,
    pub rows: &'a [Row],
}

impl Told<'_> {
    /// Writes STEM.svg, STEM.png and STEM.html; says so, or why there is nothing to draw.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, stem: &Path) -> Result<String, String> {
        if self.points(Cost::ParticleUpdates).is_empty() {
            return Ok(format!("no chart: no run has a {} above 0", self.measures.judged_by()));
        }
        let charts: Vec<Picture> = CHARTED.map(|cost| Picture::Chart(self.chart(cost))).into();
        Picture::Row(charts.clone()).write(stem)?;
        let page = stem.with_file_name(format!("{}.html", stem.file_name().unwrap_or_default().display()));
        self.page(charts).write(&page)?;
        Ok(format!("charts in {}, .svg and .png", page.display()))
    }

    /// Cost and error of each row that a chart with logarithmic axes can show.
    fn points(&self, cost: Cost) -> Vec<(&Row, [f64; 2])> {
        let point = |row: &Row| Some([row.cost_of(cost)?, self.scale() * self.measures.error(row)?]);
        let shown = |[cost, error]: &[f64; 2]| *cost > 0.0 && *error > 0.0;
        self.rows.iter().filter_map(|row| point(row).filter(shown).map(|point| (row, point))).collect()
    }

    fn scale(&self) -> f64 {
        if self.measures.in_percent() { 100.0 } else { 1.0 }
    }

    fn chart(&self, cost: Cost) -> Chart {
        let names = Names::new(self.paths, self.rows);
        let best = best(self.rows, self.measures, cost);
        let front: Vec<(&Row, [f64; 2])> =
            best.iter().filter(|best| best.on_front).filter_map(|best| self.at(best, cost)).collect();
        let named = named(&front.iter().map(|(_, point)| point[1]).collect::<Vec<_>>());
        let chosen = || front.iter().zip(&named).filter(|(_, named)| **named).map(|((row, _), _)| *row);
        // One name alone would say nothing by what differs.
        let short = if chosen().count() < 2 { Names::new(self.paths, self.rows) } else { Names::new(self.paths, chosen()) };
        let label = |((row, _), named): (&(&Row, _), &bool)| if *named { short.of(row) } else { String::new() };
        let mut series = vec![Series {
            name: "Pareto front".into(),
            style: Style::Line,
            colour: 0,
            points: front.iter().map(|(_, point)| *point).collect(),
            labels: front.iter().zip(&named).map(label).collect(),
        }];
        let points = self.points(cost);
        for (row, point) in &points {
            let name = names.family(row);
            match series.iter_mut().skip(1).find(|series| series.name == name) {
                Some(series) => series.points.push(*point),
                None => {
                    let colour = series.len();
                    series.push(Series { name, style: Style::Points, colour, points: vec![*point], labels: Vec::new() });
                }
            }
        }
        let common = front.first().map_or_else(String::new, |(row, _)| names.common(&short, row));
        Chart {
            title: self.title.into(),
            note: self.note(points.len(), &common),
            x: Axis::log(cost.about()),
            y: Axis::log(self.measures.about()),
            series,
        }
    }

    fn at<'a>(&self, best: &Best<'a>, cost: Cost) -> Option<(&'a Row, [f64; 2])> {
        let point = [best.row.cost_of(cost)?, self.scale() * best.error?];
        point.iter().all(|number| *number > 0.0).then_some((best.row, point))
    }

    /// What the chart does not show, and what all settings with a name have in common.
    fn note(&self, shown: usize, common: &str) -> String {
        let hidden = self.rows.len() - shown;
        let runs = match hidden {
            0 => format!("{shown} runs"),
            _ => format!("{shown} runs; {hidden} more failed, or have no error or the error 0"),
        };
        if common.is_empty() { runs } else { format!("{runs}; all that are named: {common}") }
    }

    fn page(&self, charts: Vec<Picture>) -> Page {
        let judged = self.measures.about().trim_end_matches(", %").to_string();
        let text = |text: String| vec![text];
        Page {
            title: format!("{}: accuracy and speed", self.title),
            lead: format!("{} runs, each a setting of {}.", self.rows.len(), self.paths.join(", ")),
            sections: vec![
                Section {
                    heading: "Error and cost".into(),
                    text: text(format!(
                        "Each point is a run: its {judged}, and what it cost. No setting is both cheaper and more accurate than one \
                         on the line, the Pareto front; names tell what differs between settings."
                    )),
                    pictures: charts,
                    ..Section::default()
                },
                Section {
                    heading: "The cheapest setting for an error".into(),
                    text: text("The cheapest setting whose error is no larger.".into()),
                    table: Some(table(goals(self.paths, self.measures, self.rows))),
                    ..Section::default()
                },
                Section {
                    heading: "All settings".into(),
                    text: text(format!(
                        "By rising CPU seconds. * on the front of CPU seconds, + on that of particle-updates. {} is what they are \
                         judged by; errors are in the unit of their tolerance.",
                        self.measures.judged_by()
                    )),
                    table: Some(table(settings(self.paths, self.measures, self.rows))),
                    ..Section::default()
                },
                self.failures(),
            ],
        }
    }

    fn failures(&self) -> Section {
        let lines = self.rows.iter().filter(|row| row.status != super::row::OK);
        let lines: Vec<String> = lines.map(|row| format!("{}: {}", row.key.join(", "), row.status)).collect();
        let text = if lines.is_empty() { vec!["Every run came to its end with all its errors.".into()] } else { lines };
        Section { heading: "Runs without an end or an error".into(), text, ..Section::default() }
    }
}

/// Which points of a front bear their names: the first, and each whose error is a tenth smaller than that of the one named
/// before.
pub fn named(errors: &[f64]) -> Vec<bool> {
    let mut last = f64::INFINITY;
    let gains = |error: &f64| {
        let gains = *error <= 0.9 * last;
        last = if gains { *error } else { last };
        gains
    };
    errors.iter().map(gains).collect()
}

/// The first line as titles.
fn table(lines: Vec<Vec<String>>) -> Table {
    let mut lines = lines.into_iter();
    Table { columns: lines.next().unwrap_or_default(), rows: lines.collect() }
}
