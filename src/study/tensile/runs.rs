//! Swegle's test run by the program: a run for each curve of the figures 5.1-3 to 5.1-12 that supports a claim of the thesis.
//!
//! The scene is scenes/tension_square.toml, 51 particles a side. A run is kept as a CSV under its name, and not run again
//! while its scene's text and the program's version are the same.

use super::case::{Case, STABLE};
use super::draw::{chart, curve};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::particles::{Block, Rule, growth};
use super::points::{Point, points};
use super::published as strand;
use super::windows::digits;
use crate::run::Stop;
use crate::study::chart::{Axis, Table};
use std::path::Path;

/// A run, and its growth in theory and as seen.
struct Seen {
    point: Point,
    theory: f64,
    /// Growth rate over the last third, c/dx; None where theory finds no growth, or growth too slow for the run.
    rate: Option<f64>,
    /// E-foldings from the first speed to the largest of the last half.
    grown: f64,
    curve: Vec<(f64, f64)>,
}

impl Seen {
    fn new(point: Point, curve: Vec<(f64, f64)>) -> Self {
        let theory = point.theory(point.size()[0]);
        let end = curve[curve.len() - 1].0;
        let late = curve[curve.len() / 2..].iter().map(|row| row.1).fold(0.0, f64::max);
        let rate = (theory * end > 10.0).then(|| growth(&curve, 11.0 / 16.0 * end));
        Self { point, theory, rate, grown: (late / curve[0].1).ln(), curve }
    }
    /// Whether the run grew by more than a factor e.
    fn unstable(&self) -> bool {
        self.grown > 1.0
    }
}

/// All runs. Writes those that are new into `folder`.
pub fn runs(folder: &Path, tell: &dyn Fn(&str)) -> Result<Findings, Stop> {
    std::fs::create_dir_all(folder).map_err(|error| Stop::Failed(format!("{}: {error}", folder.display())))?;
    let mut seen = Vec::new();
    for point in points() {
        let curve = point.curve(folder, tell)?;
        seen.push(Seen::new(point, curve));
    }
    let mut findings = Findings { exhibits: vec![exhibit(&seen)], statements: Vec::new() };
    for (figure, place) in [
        ("5.1-3", "figure 5.1-3, p. 108 (runs)"),
        ("5.1-6", "figure 5.1-6, p. 112 (runs)"),
        ("5.1-7", "figure 5.1-7, p. 113, and 5.1.3.2 (runs)"),
        ("5.1-10", "figure 5.1-10, p. 119 (runs)"),
        ("5.1-11", "figure 5.1-11, p. 120 (runs)"),
        ("5.1-12", "figure 5.1-12, p. 122 (runs)"),
    ] {
        findings.statements.extend(verdicts(place, seen.iter().filter(|s| s.point.figure == figure)));
    }
    findings.statements.push(lagrangian());
    findings.statements.push(time_step());
    Ok(findings)
}

/// One statement for what he found stable, and one for what not.
fn verdicts<'a>(place: &'static str, seen: impl Iterator<Item = &'a Seen>) -> Vec<Statement> {
    let seen: Vec<&Seen> = seen.collect();
    let of = |stable: bool| {
        let list: Vec<&&Seen> = seen.iter().filter(|s| s.point.published == Some(stable)).collect();
        let names = list.iter().map(|s| s.point.name()).collect::<Vec<_>>().join(", ");
        let found = list.iter().map(|s| format!("{:.1}", s.grown)).collect::<Vec<_>>().join(", ");
        let agrees = list.iter().all(|s| s.unstable() != stable);
        let word = if stable { "stable" } else { "unstable" };
        (!list.is_empty()).then(|| Statement::new(place, format!("{word}: {names}"), format!("grew by e to the {found}"), agrees))
    };
    [true, false].into_iter().filter_map(of).collect()
}

/// How well theory and runs agree, in words.
fn theory_and_runs(seen: &[Seen]) -> String {
    let off = seen.iter().filter_map(|s| s.rate.map(|rate| (rate / s.theory - 1.0).abs())).fold(0.0, f64::max);
    let measured = seen.iter().filter(|s| s.rate.is_some()).count();
    let calm = seen.iter().filter(|s| s.theory < STABLE);
    let (quiet, all) = (calm.clone().filter(|s| !s.unstable()).count(), calm.count());
    format!(
        "Theory and runs agree with each other: {measured} growth rates within {:.1} %, and {quiet} of the {all} runs that \
         theory finds stable did not grow.",
        100.0 * off
    )
}

fn exhibit(seen: &[Seen]) -> Exhibit {
    let word = |stable: bool| if stable { "stable" } else { "unstable" };
    let rows = seen.iter().map(|s| {
        vec![
            s.point.figure.to_string(),
            s.point.name(),
            s.point.published.map_or(String::new(), |stable| word(stable).into()),
            word(!s.unstable()).into(),
            digits(if s.theory < STABLE { 0.0 } else { s.theory }),
            s.rate.map_or(String::new(), digits),
            s.rate.map_or(String::new(), |rate| format!("{:+.1} %", 100.0 * (rate / s.theory - 1.0))),
            format!("{:.1}", s.grown),
            digits(s.point.theory(21)),
        ]
    });
    let columns =
        ["figure", "run", "Strand", "here", "theory, c/dx", "measured", "difference", "e-foldings grown", "theory, 21 a side"];
    let mut pictures = Vec::new();
    for figure in ["5.1-3", "5.1-6", "5.1-7", "5.1-10", "5.1-11", "5.1-12"] {
        let series = seen.iter().filter(|s| s.point.figure == figure).enumerate();
        let series = series.map(|(k, s)| curve(s.point.name(), k, s.curve[1..].iter().map(|&(t, v)| [t, v]).collect()));
        pictures.push(chart(
            &format!("Total velocity, as in figure {figure}"),
            "",
            Axis::log("time, dx/c"),
            Axis::log("total velocity, m/s"),
            series.collect(),
        ));
    }
    let side = (strand::KICK / strand::QUIET).round();
    Exhibit {
        stem: "runs".into(),
        heading: "Swegle's test by simulation".into(),
        text: vec![
            format!(
                "51 particles a side (25 in 3D), those within 2 h of the border held, the one in the middle kicked by 1e-6 m/s; \
             theory is that of standing waves of the free inside. The thesis does not print the size of its block; a total \
             velocity of {:e} km/s after a kick of {:e} km/s says about {side} particles a side, for which the last column \
             holds. A run counts as unstable when it grew by more than one e-folding.",
                strand::QUIET,
                strand::KICK
            ),
            theory_and_runs(seen),
        ],
        pictures,
        table: Some(Table { columns: table_columns(&columns), rows: rows.collect() }),
    }
}

/// Total Lagrangian particles at V 1.05, with the small loop.
fn lagrangian() -> Statement {
    let rule = Rule { lagrangian: true, ..Rule::default() };
    let rows = Block::new(Case::new(2, 1.3).volume(1.05), rule, 21, 2e-10).run(300.0, 60, 0.2);
    let most = rows.iter().map(|row| row.speed).fold(0.0, f64::max) / rows[0].speed;
    Statement::new(
        "figure 5.1-3, p. 108",
        "Total Lagrangian particles at V 1.05 are stable",
        format!("in 300 dx/c the total velocity never exceeds {} times its start", digits(most)),
        most < 1.1,
    )
}

/// Growth at half the time step.
fn time_step() -> Statement {
    let rate = |dt: f64| {
        let rows = Block::new(Case::new(1, 1.3).epsilon(1.3), Rule::default(), 51, 2e-10).run(100.0, 100, dt);
        growth(&rows.iter().map(|row| (row.time, row.speed)).collect::<Vec<_>>(), 50.0)
    };
    let (whole, half) = (rate(0.2), rate(0.1));
    Statement::new(
        "5.1.3.3, p. 114",
        "the time step has no effect on the force",
        format!("growth at epsilon 1.3 on a line changes by {:.1e} when it is halved", (half / whole - 1.0).abs()),
        (half / whole - 1.0).abs() < 0.01,
    )
}
