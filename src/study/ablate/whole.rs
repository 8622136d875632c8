//! Series of the whole scene, kept beside a study's rows: what the runs of a later start are compared with.

use super::measure::series;
use crate::observable::Table;
use crate::output::{csv, durable};
use crate::run::Finished;
use std::path::Path;

/// Series as they are, and profiles as series of one number.
pub fn table(finished: &Finished) -> Table {
    let times = finished.table.times.clone();
    let column = |(name, values): (&String, Vec<f64>)| match finished.table.columns.contains_key(name) {
        true => (name.clone(), values),
        false => (name.clone(), vec![values[0]; times.len()]),
    };
    let columns = series(finished).map(column).collect();
    Table { times, columns }
}

/// # Errors
/// Where the file cannot be written.
pub fn write(path: &Path, finished: &Finished) -> Result<(), String> {
    let table = table(finished);
    let names: Vec<String> = std::iter::once("time").chain(table.columns.keys().map(String::as_str)).map(String::from).collect();
    let row = |(k, &time): (usize, &f64)| std::iter::once(time).chain(table.columns.values().map(|column| column[k])).collect();
    let text = csv::text(&names, table.times.iter().enumerate().map(row))?;
    durable::put(path, &[text.as_bytes()])
}

/// # Errors
/// Where there is no such file, or it holds no series.
pub fn read(path: &Path) -> Result<Table, String> {
    let (names, rows) = csv::read(path)?;
    let column = |k: usize| rows.iter().map(|row| row[k]).collect();
    let columns = names.iter().enumerate().skip(1).map(|(k, name)| (name.clone(), column(k))).collect();
    Ok(Table { times: column(0), columns })
}
