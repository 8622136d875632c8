//! What an ablation found as pictures and as a page.

use super::judge::{Judge, Verdict};
use super::measure::Expected;
use super::piece::{Piece, Sort};
use super::report::{TITLES, cells, sentences};
use super::{Found, Request};
use crate::scene::Scene;
use crate::study::accuracy::row::Row;
use crate::study::chart::{Axis, Chart, Page, Picture, Section, Series, Style, Table};
use std::path::Path;

/// What stands for less on a logarithmic axis.
const LEAST: f64 = 1e-8;
/// What stands for more.
const MOST: f64 = 1e6;

/// Writes the picture and the page beside the CSV.
///
/// # Errors
/// Where a file cannot be written.
pub fn write(csv: &Path, scene: &Scene, request: &Request, found: &Found) -> Result<(), String> {
    let picture = Picture::Row(vec![against_tolerance(scene, found), against_whole(scene, found)]);
    let stem = csv.with_extension("");
    picture.write(&stem)?;
    let page = Page {
        title: format!("What {} needs", scene.label()),
        lead: format!(
            "{}. Taken apart piece by piece: what each piece changes and saves, and the smallest model within {}.",
            scene.file.title,
            request.error.map_or_else(|| "the scene's tolerances".into(), |error| format!("an error of {} %", 100.0 * error)),
        ),
        sections: vec![
            Section {
                heading: "Without each piece".into(),
                text: sentences(scene, request, found),
                pictures: vec![picture],
                table: Some(overview(found)),
                ..Section::default()
            },
            Section {
                heading: "What is expected".into(),
                text: vec!["The number of each run, and over what is tolerated: 1 is just good.".into()],
                table: Some(expectations(found)),
                ..Section::default()
            },
            Section {
                heading: "What is observed".into(),
                text: vec![
                    "The largest difference from the whole scene over all rows at the same times, and that over its largest \
                     magnitude."
                        .into(),
                ],
                table: Some(observables(found)),
                ..Section::default()
            },
        ],
    };
    page.write(&csv.with_extension("html"))
}

/// Points of all pieces of one kind: processor time over the whole scene's, and a number.
fn points(
    found: &Found,
    number: impl Fn(&Row) -> Option<f64>,
    of: impl Fn(&Piece, &Verdict) -> bool,
) -> (Vec<[f64; 2]>, Vec<String>) {
    let chosen = found.rows.iter().filter(|(piece, row)| of(piece, &found.judge.verdict(row)));
    let point = |(piece, row): &(Piece, Row)| Some((place(&found.judge, row, number(row)?)?, piece.name.clone()));
    chosen.filter_map(point).unzip()
}

fn place(judge: &Judge, row: &Row, number: f64) -> Option<[f64; 2]> {
    let [cpu, ..] = judge.saved(row)?;
    Some([1.0 - cpu, if number.is_nan() { MOST } else { number.clamp(LEAST, MOST) }])
}

fn chart(found: &Found, title: String, y: &str, limit: Option<f64>, number: impl Fn(&Row) -> Option<f64>) -> Picture {
    let series = |name: &str, colour: usize, (points, labels): (Vec<[f64; 2]>, Vec<String>)| Series {
        name: name.into(),
        style: Style::Points,
        colour,
        points,
        labels,
    };
    let goes = |sort: Sort| move |piece: &Piece, verdict: &Verdict| piece.sort == sort && verdict.may_go();
    let mut list = vec![
        series("needed, or not to be judged", 3, points(found, &number, |_, verdict| !verdict.may_go())),
        series("not needed", 2, points(found, &number, goes(Sort::Named))),
        series("enough", 0, points(found, &number, goes(Sort::Reduced))),
    ];
    if let Some((_, row)) = &found.smallest
        && let Some(at) = number(row).and_then(|number| place(&found.judge, row, number))
    {
        list.push(series("smallest model", 1, (vec![at], vec!["smallest".into()])));
    }
    list.retain(|series| !series.points.is_empty());
    if let Some(limit) = limit {
        let right = list.iter().flat_map(|series| &series.points).map(|point| point[0]).fold(1.0, f64::max);
        let points = vec![[0.0, limit], [right, limit]];
        list.push(Series { name: "tolerance".into(), style: Style::Dashed, colour: 7, points, labels: Vec::new() });
    }
    Picture::Chart(Chart {
        title,
        note: format!("Numbers below {LEAST:e} are shown there. Processor time is that of one run on a shared machine."),
        x: Axis::linear("processor time over the whole scene's"),
        y: Axis::log(y),
        series: list,
    })
}

fn against_tolerance(scene: &Scene, found: &Found) -> Picture {
    let title = format!("{}: error without each piece", scene.label());
    chart(found, title, "largest error over its tolerance", Some(1.0), |row| found.judge.worst(row).map(|worst| worst.1))
}

fn against_whole(scene: &Scene, found: &Found) -> Picture {
    let title = format!("{}: change of the observables", scene.label());
    let change = |row: &Row| found.judge.largest_change(row).map(|change| change.1);
    chart(found, title, "largest relative change", None, change)
}

/// All runs: the whole scene's, those without a piece, the smallest model's.
fn runs(found: &Found) -> impl Iterator<Item = (&str, String, &Row)> {
    let judge = &found.judge;
    let pieces = found.rows.iter().map(|(piece, row)| (piece.name.as_str(), found.says(piece, row), row));
    let smallest = found.smallest.iter().map(|(_, row)| ("the smallest model", "confirmed by its run".to_string(), row));
    std::iter::once(("(nothing)", String::new(), &judge.whole)).chain(pieces).chain(smallest)
}

fn overview(found: &Found) -> Table {
    let rows = runs(found).map(|(name, verdict, row)| cells(name, &verdict, &found.judge, row)).collect();
    Table { columns: TITLES.map(String::from).to_vec(), rows }
}

fn shown(number: Option<f64>) -> String {
    number.map_or_else(|| "-".into(), |number| format!("{number:.3e}"))
}

fn expectations(found: &Found) -> Table {
    let judge = &found.judge;
    let titles = |expected: &Expected| {
        let word = if expected.is_error() { "error" } else { "seen" };
        [format!("{word} of {}", expected.name), "over its tolerance".into()]
    };
    let columns = std::iter::once("without".to_string()).chain(judge.expected.iter().flat_map(titles)).collect();
    let cells = |(name, _, row): (&str, String, &Row)| {
        let scores = judge.scores(row);
        let pair = |k: usize| [shown(judge.expectation(row, k)), shown(scores[k].1)];
        std::iter::once(name.to_string()).chain((0..judge.expected.len()).flat_map(pair)).collect()
    };
    Table { columns, rows: runs(found).map(cells).collect() }
}

fn observables(found: &Found) -> Table {
    let judge = &found.judge;
    let titles = judge.observed.iter().flat_map(|name| [format!("change of {name}"), "of its magnitude".into()]);
    let columns = std::iter::once("without".to_string()).chain(titles).collect();
    let cells = |(name, _, row): (&str, String, &Row)| {
        let pair = |k: usize| [shown(judge.observable(row, k)[1]), shown(judge.observable(row, k)[2])];
        std::iter::once(name.to_string()).chain((0..judge.observed.len()).flat_map(pair)).collect()
    };
    Table { columns, rows: runs(found).skip(1).map(cells).collect() }
}
