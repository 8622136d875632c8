//! What a study of stability says: tables, pictures and the page.

use super::points::Runs;
use super::setting::Setting;
use super::simulate::Measured;
use super::study::{Found, beside};
use crate::output::csv::shortest;
use crate::study::accuracy::report::aligned;
use crate::study::chart::{Axis, Chart, Page, Picture, Section, Series, Style, Table};
use std::path::Path;

const COLUMNS: [&str; 7] =
    ["fastest kx dx", "ky dx", "kz dx", "rate dx/c", "largest frequency dx/c", "leapfrog step", "leapfrog step c/h"];

/// A row for each setting, the first their names; no wave where none grows.
pub fn setting_rows(paths: &[String], found: &[Found]) -> Vec<Vec<String>> {
    rows(paths, &COLUMNS, found, |one| {
        vec![numbers(one).iter().map(|&number| if number.is_nan() { String::new() } else { shortest(number) }).collect()]
    })
}

fn numbers(found: &Found) -> [f64; 7] {
    let (setting, growth) = (&found.setting, &found.growth);
    let [x, y, z] = growth.wave.map(|k| if growth.mode.rate > 0.0 { k * setting.spacing() } else { f64::NAN });
    let unit = setting.unit_rate();
    let step = growth.leapfrog_step;
    let over = step * setting.sound_speed() / setting.smoothing_length();
    [x, y, z, growth.mode.rate / unit, growth.largest_frequency / unit, step, over]
}

/// A row for each integrator of each setting.
pub fn limit_rows(paths: &[String], found: &[Found]) -> Vec<Vec<String>> {
    let columns = ["integrator", "omega dt", "computed", "measured", "measured/computed"];
    rows(paths, &columns, found, |one| {
        let (limits, secular) = one.limits.as_ref().map_or((&[][..], None), |(limits, secular)| (&limits[..], Some(secular)));
        let limit = |limit: &super::Limit| {
            let numbers = [limit.formula, limit.computed, limit.measured, limit.ratio()];
            std::iter::once(limit.integrator.word().to_string()).chain(numbers.map(digits)).collect()
        };
        let growth = secular.map(|s| {
            let name = format!("{}: growth a step", s.integrator.word());
            let numbers = [s.omega_step, s.computed, s.measured, s.measured / s.computed];
            std::iter::once(name).chain(numbers.map(digits)).collect()
        });
        limits.iter().map(limit).chain(growth).collect()
    })
}

fn rows(paths: &[String], columns: &[&str], found: &[Found], of: impl Fn(&Found) -> Vec<Vec<String>>) -> Vec<Vec<String>> {
    let names = paths.iter().cloned().chain(columns.iter().map(|name| (*name).to_string())).collect();
    let own = found.iter().flat_map(|one| of(one).into_iter().map(|row| one.values.iter().cloned().chain(row).collect()));
    std::iter::once(names).chain(own).collect()
}

/// Five digits; nothing where there is no number.
fn digits(number: f64) -> String {
    if number.is_nan() {
        return String::new();
    }
    if number == 0.0 || (1e-3..1e5).contains(&number.abs()) { format!("{number:.5}") } else { format!("{number:.4e}") }
}

/// Tables for the terminal.
pub fn text(paths: &[String], found: &[Found], runs: Option<&Runs>, out: &Path) -> String {
    let short = |one: &Found| vec![numbers(one).iter().map(|&number| digits(number)).collect()];
    let mut parts = vec![aligned(&rows(paths, &COLUMNS, found, short), paths.len())];
    if found.iter().any(|one| one.limits.is_some()) {
        parts.push(aligned(&limit_rows(paths, found), paths.len() + 1));
    }
    if let Some(runs) = runs {
        parts.extend(found.iter().map(|one| agreement(one, runs)));
    }
    parts.push(format!("written to {} and beside it", out.display()));
    parts.join("\n")
}

/// How near the runs of a setting come to theory.
fn agreement(found: &Found, runs: &Runs) -> String {
    let runs: Vec<&Measured> = runs.of(&found.values).collect();
    let within = runs.iter().filter(|run| run.difference.abs() <= 0.1).count();
    let largest = runs.iter().map(|run| run.difference.abs()).fold(0.0, f64::max);
    let (name, count) = (name(&found.values), runs.len());
    let damped = match (found.setting.filters(), found.setting.dissipates()) {
        (true, _) => "; theory leaves out the velocity filter of the runs",
        (false, true) => "; theory has viscosity to first order",
        (false, false) => "",
    };
    format!("{name}{count} waves run, {within} within 10 % of theory, largest difference {:.2} %{damped}", 100.0 * largest)
}

fn name(values: &[String]) -> String {
    if values.is_empty() { String::new() } else { format!("{}: ", values.join(", ")) }
}

/// Pictures, each as SVG and PNG, and the page.
pub fn write(label: &str, paths: &[String], found: &[Found], runs: Option<&Runs>, out: &Path) -> Result<(), String> {
    let mut sections = vec![Section {
        heading: "Settings".into(),
        text: vec![
            "The fastest growing plane wave of each setting, the largest frequency of all waves, and leapfrog's longest step, \
             2 over that frequency. dx is the particle spacing, h the smoothing length, c the speed of longitudinal waves in \
             the unstressed body."
                .into(),
        ],
        table: Some(table(&rows(paths, &COLUMNS, found, |one| vec![numbers(one).iter().map(|&n| digits(n)).collect()]))),
        ..Section::default()
    }];
    for (k, one) in found.iter().enumerate() {
        let name = if one.values.is_empty() { label.to_string() } else { one.values.join(", ") };
        let measured: Vec<&Measured> = runs.map_or_else(Vec::new, |runs| runs.of(&one.values).collect());
        let picture = one.zone.picture(&name, &one.growth, &one.setting, &measured);
        let stem = if found.len() > 1 { beside(out, &format!("-{}", k + 1)) } else { beside(out, "") };
        picture.write(&stem)?;
        let mut section = Section { heading: name, pictures: vec![picture], ..Section::default() };
        if let Some(runs) = runs {
            section.text.push(agreement(one, runs));
            section.table = Some(run_table(one, runs));
        }
        sections.push(section);
    }
    if let Some(runs) = runs.filter(|runs| !runs.rows.is_empty()) {
        let picture = comparison(found, runs);
        picture.write(&beside(out, "-runs"))?;
        let heading = "Runs beside theory".into();
        sections.insert(1, Section { heading, pictures: vec![picture], ..Section::default() });
    }
    if found.iter().any(|one| one.limits.is_some()) {
        sections.push(limits_section(paths, found));
    }
    let title = format!("Stability of {label}");
    let lead = "Von Neumann's analysis of the discrete equations that the passes solve, on an infinite square lattice.".into();
    Page { title, lead, sections }.write(&beside(out, ".html"))
}

fn limits_section(paths: &[String], found: &[Found]) -> Section {
    Section {
        heading: "Longest steps".into(),
        text: vec![
            "The largest omega dt at which an oscillator does not grow, that over the largest frequency of the discrete \
             equations, and the step from which on runs of 2000 steps, kicked at one particle, grow. rk2 has no stable step: \
             its row has the growth of the fastest oscillation's amplitude a step. The lattice has no end: the edges of a body \
             may ask for shorter steps, and so does viscosity."
                .into(),
        ],
        table: Some(table(&limit_rows(paths, found))),
        ..Section::default()
    }
}

fn table(rows: &[Vec<String>]) -> Table {
    Table { columns: rows[0].clone(), rows: rows[1..].to_vec() }
}

fn run_table(found: &Found, runs: &Runs) -> Table {
    let dimension = found.setting.dimension();
    let axes = ["kx dx", "ky dx", "kz dx"].into_iter().take(dimension);
    let own = ["theory rate", "theory frequency", "rate", "frequency", "difference"];
    let row = |run: &Measured| {
        let numbers = [run.theory.rate, run.theory.frequency, run.rate, run.frequency].map(digits);
        let waves = run.wave.into_iter().take(dimension).map(digits);
        waves.chain(numbers).chain([format!("{:.2} %", 100.0 * run.difference)]).collect()
    };
    Table { columns: axes.chain(own).map(str::to_string).collect(), rows: runs.of(&found.values).map(row).collect() }
}

/// Measured rates and frequencies over those of theory.
fn comparison(found: &[Found], runs: &Runs) -> Picture {
    let of = |grows: bool, name: &str, colour: usize| {
        let all = found.iter().flat_map(|one| runs.of(&one.values));
        let point = |run: &Measured| match grows {
            true => [run.theory.rate, run.rate],
            false => [run.theory.frequency, run.frequency],
        };
        let points = all.filter(|run| (run.theory.rate > 0.0) == grows).map(point).collect();
        Series { name: name.into(), style: Style::Points, colour, points, labels: Vec::new() }
    };
    let measured = [of(true, "growth rate", 1), of(false, "frequency", 0)];
    let largest = measured.iter().flat_map(|series| &series.points).map(|point| point[0]).fold(0.0, f64::max);
    let line = Series {
        name: "equal".into(),
        style: Style::Dashed,
        colour: 7,
        points: vec![[0.0, 0.0], [largest, largest]],
        labels: Vec::new(),
    };
    let series = measured.into_iter().filter(|series| !series.points.is_empty()).chain([line]).collect();
    Picture::Chart(Chart {
        title: "Runs beside theory".into(),
        note: "each point a plane wave".into(),
        x: Axis::linear("theory, c/dx"),
        y: Axis::linear("run, c/dx"),
        series,
    })
}

impl Measured {
    /// With rates and frequencies over c/dx and the wave times dx.
    pub(super) fn over(self, setting: &Setting) -> Self {
        let unit = setting.unit_rate();
        let theory = super::Mode { rate: self.theory.rate / unit, frequency: self.theory.frequency / unit, ..self.theory };
        let wave = self.wave.map(|k| k * setting.spacing());
        Self { wave, theory, rate: self.rate / unit, frequency: self.frequency / unit, ..self }
    }
}
