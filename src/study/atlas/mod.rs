//! The atlas of known failures: each row runs the plain method, which fails, and its remedy, which survives, and tells
//! them apart by one number. `lithosph study atlas` makes the page; `tests/study/atlas.rs` holds every row to what it states.
//!
//! A row is a scene of `scenes/` with changes, or a scene beside the row, and a line in [`rows::ROWS`]. A run leaves its
//! series and particles in a folder of its own, from which page and numbers can be made again, so that the same command
//! goes on where a kill left it.

mod outcome;
mod page;
mod row;
pub mod rows;
mod side;
mod table;

pub use outcome::Outcome;
pub use row::{Bound, Measure, Row, Trace, Verdict};
pub use side::{Machine, Side, Size, Text};

use crate::run::Stop;
use crate::scene::read::hint;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::PathBuf;
use std::time::Instant;
use table::{Record, Table};

/// What the command line asks of the atlas.
#[derive(Debug, Clone)]
pub struct Request {
    /// Names of the rows to run; all where empty.
    pub rows: Vec<String>,
    /// Folder of `atlas.csv`, `atlas.html` and `atlas/`.
    pub out: PathBuf,
    /// Runs rows that the table holds already.
    pub force: bool,
}

/// Runs what the table lacks and writes the page; gives the table as text, and whether every row that was asked for
/// behaved as stated.
///
/// # Errors
/// An unknown row, a file that is no table of this kind, a run that is refused or goes wrong, or the user.
pub fn run(request: &Request) -> Result<(String, bool), Stop> {
    let wanted = chosen(&request.rows).map_err(Stop::Refused)?;
    let mut table = Table::open(&request.out.join("atlas.csv")).map_err(Stop::Refused)?;
    let bar = progress(wanted.len());
    for row in &wanted {
        bar.set_message(row.name);
        if request.force || !table.holds(row) {
            finish(row, request, &mut table, &bar)?;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    page::write(&request.out, &table).map_err(Stop::Failed)?;
    let as_stated = wanted.iter().all(|row| table.find(row).is_some_and(|record| record.verdict.as_stated));
    Ok((table.text(&wanted), as_stated))
}

/// Runs a row and records it.
fn finish(row: &'static Row, request: &Request, table: &mut Table, bar: &ProgressBar) -> Result<(), Stop> {
    let begin = Instant::now();
    let folder = page::folder(&request.out, row);
    let ran = row.run(&folder, Size::Full, |side| bar.set_message(format!("{}, {side}", row.name)));
    let verdict = ran.map_err(|stop| match stop {
        Stop::Interrupted(_) => interrupted(row, table),
        stop => stop,
    })?;
    page::paint(&request.out, row).map_err(Stop::Failed)?;
    table.record(Record { row, verdict, seconds: begin.elapsed().as_secs_f64() }).map_err(Stop::Failed)
}

fn interrupted(row: &Row, table: &Table) -> Stop {
    let file = table.path.display();
    Stop::Interrupted(format!(
        "interrupted in {}; finished rows are in {file}, and the same command goes on from there",
        row.name
    ))
}

/// Rows by name, in the order of the atlas.
fn chosen(names: &[String]) -> Result<Vec<&'static Row>, String> {
    let known: Vec<&str> = rows::ROWS.iter().map(|row| row.name).collect();
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(format!("the atlas has no row `{name}`{}", hint(name, &known)));
    }
    Ok(rows::ROWS.iter().copied().filter(|row| names.is_empty() || names.iter().any(|name| name == row.name)).collect())
}

/// Hidden by itself where stderr is no terminal.
fn progress(rows: usize) -> ProgressBar {
    let bar = ProgressBar::new(rows as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len}  {msg}  {elapsed_precise}") {
        bar.set_style(style);
    }
    bar
}
