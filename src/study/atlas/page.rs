//! The page: a table of all finished rows, and a section for each.

use super::table::Table;
use super::{Outcome, Row, Side, Size};
use crate::output::save_png;
use crate::study::chart::{Axis, Chart, Page, Picture, Section, Series, Style, Table as Cells};
use image::{GenericImage, Rgba, RgbaImage};
use std::path::{Path, PathBuf};

/// Where a row's runs are.
pub fn folder(out: &Path, row: &Row) -> PathBuf {
    out.join("atlas").join(row.name)
}

fn outcome(out: &Path, row: &Row, side: &Side, word: &str) -> Result<Outcome, String> {
    Outcome::read(side.scene(Size::Full, &[])?, &folder(out, row).join(word))
}

/// Both runs' outcomes as they were left.
fn outcomes(out: &Path, row: &Row) -> Result<[Outcome; 2], String> {
    Ok([outcome(out, row, &row.plain, "plain")?, outcome(out, row, &row.remedy, "remedy")?])
}

/// Writes the pictures of a row beside its runs.
pub fn paint(out: &Path, row: &Row) -> Result<(), String> {
    let outcomes = outcomes(out, row)?;
    let stem = out.join("atlas").join(row.name);
    save_png(&stem.with_extension("png"), &abreast(&outcomes[0].picture()?, &outcomes[1].picture()?))?;
    match chart(row, &outcomes)? {
        Some(picture) => picture.write(&out.join("atlas").join(format!("{}-trace", row.name))),
        None => Ok(()),
    }
}

/// Two pictures side by side on white.
fn abreast(left: &RgbaImage, right: &RgbaImage) -> RgbaImage {
    let (width, height) = (left.width() + right.width(), left.height().max(right.height()));
    let mut both = RgbaImage::from_pixel(width, height, Rgba([255; 4]));
    for (picture, x) in [(left, 0), (right, left.width())] {
        both.copy_from(picture, x, 0).expect("the canvas is as large as both");
    }
    both
}

/// The series that a row charts, over the time of the shorter run.
fn chart(row: &Row, outcomes: &[Outcome; 2]) -> Result<Option<Picture>, String> {
    let Some(trace) = row.trace else { return Ok(None) };
    let series = |k: usize, side: &Side| {
        let values = outcomes[k].series(trace.series)?;
        let points = outcomes[k].table.times.iter().zip(values).map(|(&t, &value)| [t, value]);
        let points = points.filter(|p| p[1].is_finite() && (!trace.log || p[1] > 0.0)).collect();
        Ok(Series { name: side.method.into(), style: Style::Line, colour: k, points, labels: Vec::new() })
    };
    let unit = outcomes[0].scene.unit_names()[2];
    let time = if unit == "T" { "time".to_string() } else { format!("time ({unit})") };
    let y = if trace.log { Axis::log(trace.about) } else { Axis::linear(trace.about) };
    Ok(Some(Picture::Chart(Chart {
        title: row.name.replace('_', " "),
        note: String::new(),
        x: Axis::linear(time),
        y,
        series: [series(0, &row.plain), series(1, &row.remedy)].into_iter().collect::<Result<_, String>>()?,
    })))
}

/// Writes `atlas.html` of the finished rows.
pub fn write(out: &Path, table: &Table) -> Result<(), String> {
    let sections = table.records.iter().map(|record| section(out, record.row, table));
    let sections = std::iter::once(Ok(summary(table))).chain(sections).collect::<Result<Vec<Section>, String>>()?;
    let page = Page {
        title: "Atlas of failures".into(),
        lead: "Known failures of the method, one a row: the plain method fails, its remedy survives, and one number tells them \
               apart. Every row is also a test."
            .into(),
        sections,
    };
    page.write(&out.join("atlas.html"))
}

fn number(value: f64) -> String {
    let plain = value == 0.0 || (1e-2..1e4).contains(&value.abs());
    if plain { format!("{value:.3}") } else { format!("{value:.2e}") }
}

fn summary(table: &Table) -> Section {
    let columns = ["row", "plain", "fails if", "remedy", "survives if", "verdict", "measure"].map(String::from).to_vec();
    let cells = table.records.iter().map(|record| {
        let (row, verdict) = (record.row, record.verdict);
        let [plain, remedy] = [verdict.plain, verdict.remedy].map(number);
        let judged = record.verdict().to_string();
        vec![row.name.into(), plain, row.fails.text(), remedy, row.survives.text(), judged, row.measure.about.into()]
    });
    let rows = cells.collect();
    Section { heading: "All rows".into(), text: vec![], pictures: vec![], images: vec![], table: Some(Cells { columns, rows }) }
}

fn section(out: &Path, row: &Row, table: &Table) -> Result<Section, String> {
    let outcomes = outcomes(out, row)?;
    let record = table.find(row).ok_or("a section belongs to a finished row")?;
    let columns = ["", "method", row.measure.about, "bound", "command"].map(String::from).to_vec();
    let line = |word: &str, side: &Side, value: f64, bound: String| {
        vec![word.to_string(), side.method.to_string(), number(value), bound, side.command()]
    };
    let rows = vec![
        line("plain", &row.plain, record.verdict.plain, format!("fails if {}", row.fails.text())),
        line("remedy", &row.remedy, record.verdict.remedy, format!("survives if {}", row.survives.text())),
    ];
    let shown = |word: &str, side: &Side, outcome: &Outcome| Ok((format!("{word}: {}", side.method), outcome.picture()?));
    let [plain, remedy] = &outcomes;
    let images = [shown("Plain", &row.plain, plain), shown("Remedy", &row.remedy, remedy)];
    let broken = outcomes.iter().filter_map(|outcome| outcome.stopped.as_ref().map(|why| format!("Broke off: {why}."))).collect();
    let source = format!("Source: {}.", row.source);
    Ok(Section {
        heading: row.name.replace('_', " "),
        text: [vec![row.failure.into()], broken, vec![source]].concat(),
        pictures: chart(row, &outcomes)?.into_iter().collect(),
        images: images.into_iter().collect::<Result<_, String>>()?,
        table: Some(Cells { columns, rows }),
    })
}
