//! The table as a page, with a chart of time against memory.

use super::Row;
use super::report::{TITLES, cells, verdict};
use crate::study::chart::{Axis, Chart, Page, Picture, Section, Series, Style, Table};
use std::path::Path;

/// Writes the chart and the page beside the CSV.
///
/// # Errors
/// Where a file cannot be written.
pub fn write(csv: &Path, rows: &[Row]) -> Result<(), String> {
    let picture = chart(rows);
    picture.write(&csv.with_extension(""))?;
    let table = Table { columns: TITLES.map(String::from).to_vec(), rows: rows.iter().map(|row| cells(row).to_vec()).collect() };
    let names = |row: &Row| vec![row.scene.clone(), row.fields.join(", "), row.passes.join(", ")];
    let lists =
        Table { columns: ["scene", "fields", "passes"].map(String::from).to_vec(), rows: rows.iter().map(names).collect() };
    let page = Page {
        title: "What each scene pays for".into(),
        lead: verdict(rows).trim().into(),
        sections: vec![
            Section { heading: "Cost".into(), pictures: vec![picture], table: Some(table), ..Section::default() },
            Section { heading: "Fields and passes".into(), table: Some(lists), ..Section::default() },
        ],
    };
    page.write(&csv.with_extension("html"))
}

fn chart(rows: &[Row]) -> Picture {
    let series = |(colour, formulation): (usize, &str)| {
        let own = rows.iter().filter(|row| row.formulation == formulation);
        let point =
            |row: &Row| Some(([row.bytes[1], 1e9 * row.step?.processor_seconds / row.particles as f64], row.scene.clone()));
        let (points, labels) = own.filter_map(point).unzip();
        Series { name: formulation.into(), style: Style::Points, colour, points, labels }
    };
    let formulations = ["eulerian", "total_lagrangian", "corrected_kernel", "eulerian + total_lagrangian"];
    let series = formulations.into_iter().enumerate().map(series).filter(|series| !series.points.is_empty()).collect();
    Picture::Chart(Chart {
        title: "Time of a step against memory".into(),
        note: "Processor time a particle and step of all threads; tables in f64, without the distinct bonds of a lattice.".into(),
        x: Axis::log("bytes a particle"),
        y: Axis::log("ns a particle and step"),
        series,
    })
}
