//! Finished rows, in a CSV that is written anew after each: a kill leaves the one before.

use super::{Row, Side, Size, Verdict, rows};
use crate::output::csv::shortest;
use crate::study::accuracy::table::{cells, line};
use std::path::{Path, PathBuf};

/// A finished row.
#[derive(Debug, Clone, Copy)]
pub struct Record {
    pub row: &'static Row,
    pub verdict: Verdict,
    pub seconds: f64,
}

/// The finished rows of a folder, in the order of the atlas.
#[derive(Debug)]
pub struct Table {
    pub path: PathBuf,
    pub records: Vec<Record>,
}

const COLUMNS: [&str; 9] = ["row", "measure", "plain", "fails_if", "remedy", "survives_if", "verdict", "seconds", "stamp"];
const AS_STATED: &str = "as stated";

impl Table {
    /// Reads what a folder has; rows of another version, whose scenes have changed since, or whose runs are gone, do not
    /// count.
    ///
    /// # Errors
    /// The file is something else or cannot be read.
    pub fn open(path: &Path) -> Result<Self, String> {
        let text = match std::fs::read_to_string(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(format!("cannot read {}: {error}", path.display())),
            Ok(text) if text.starts_with(&header()) => text,
            Ok(_) => return Err(format!("{} is there and no atlas wrote it: --out names another folder", path.display())),
        };
        let records = text.lines().skip(1).filter_map(|line| Record::from_cells(&cells(line)));
        let runs = path.with_extension("");
        let records = records.filter(|record| runs.join(record.row.name).is_dir()).collect();
        Ok(Self { path: path.into(), records })
    }

    pub fn find(&self, row: &Row) -> Option<&Record> {
        self.records.iter().find(|record| record.row.name == row.name)
    }

    pub fn holds(&self, row: &Row) -> bool {
        self.find(row).is_some()
    }

    /// Adds a row, or puts it in the place of its former self, and writes the file.
    pub fn record(&mut self, record: Record) -> Result<(), String> {
        self.records.retain(|other| other.row.name != record.row.name);
        self.records.push(record);
        self.records.sort_by_key(|record| rows::ROWS.iter().position(|row| row.name == record.row.name));
        let lines = self.records.iter().map(|record| line(&record.cells()) + "\n");
        let text: String = std::iter::once(header()).chain(lines).collect();
        crate::output::durable::put(&self.path, &[text.as_bytes()])
    }

    /// The rows that were asked for, side by side.
    pub fn text(&self, wanted: &[&Row]) -> String {
        let width = wanted.iter().map(|row| row.name.len()).max().unwrap_or(0);
        let mut out = format!("{:<width$} {:>11} {:<10} {:>11} {:<10} {:<12} measure\n", "row", "plain", "", "remedy", "", "");
        for record in wanted.iter().filter_map(|row| self.find(row)) {
            let Record { row, verdict, .. } = record;
            out += &format!(
                "{:<width$} {:>11.4e} {:<10} {:>11.4e} {:<10} {:<12} {}\n",
                row.name,
                verdict.plain,
                row.fails.text(),
                verdict.remedy,
                row.survives.text(),
                record.verdict(),
                row.measure.about
            );
        }
        out.trim_end().to_string()
    }
}

impl Record {
    pub fn verdict(&self) -> &'static str {
        if self.verdict.as_stated { AS_STATED } else { "NOT AS STATED" }
    }

    fn cells(&self) -> Vec<String> {
        let (row, verdict) = (self.row, &self.verdict);
        let plain = [shortest(verdict.plain), row.fails.text()];
        let remedy = [shortest(verdict.remedy), row.survives.text()];
        let head = [row.name.to_string(), row.measure.about.to_string()];
        let tail = [self.verdict().to_string(), format!("{:.1}", self.seconds), stamp(row)];
        [head.to_vec(), plain.to_vec(), remedy.to_vec(), tail.to_vec()].concat()
    }

    /// `None` where the line is of no row as it is now.
    fn from_cells(cells: &[String]) -> Option<Self> {
        let [name, _, plain, _, remedy, _, _, seconds, mark] = cells else { return None };
        let row = rows::ROWS.iter().copied().find(|row| row.name == name && stamp(row) == *mark)?;
        let (plain, remedy): (f64, f64) = (plain.parse().ok()?, remedy.parse().ok()?);
        let as_stated = row.fails.holds(plain) && row.survives.holds(remedy);
        Some(Self { row, verdict: Verdict { plain, remedy, as_stated }, seconds: seconds.parse().ok()? })
    }
}

fn header() -> String {
    COLUMNS.join(",") + "\n"
}

/// Changes with the version, the measure and both runs.
fn stamp(row: &Row) -> String {
    let run = |side: &Side| format!("{:?} {}", side.scene(Size::Full, &[]).map(|scene| scene.text), side.command());
    let words = [env!("CARGO_PKG_VERSION").to_string(), row.measure.about.to_string(), run(&row.plain), run(&row.remedy)];
    format!("{:016x}", crate::study::accuracy::source::hash(words.join("\n").as_bytes()))
}
