//! The CSV of a study: text cells, one flushed row a run, taken up again where a kill left it.
//!
//! Every repeat is a row of its own, so that a kill loses one run and a reader sees the scatter; the table at the
//! end of a study keeps the cheapest of them.

use super::row::Row;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// What a file must begin with to be of this study.
#[derive(Debug)]
pub struct Header {
    /// Version, scene, and a hash of all that its errors hang on.
    pub stamp: String,
    pub columns: Vec<String>,
    /// Expectations among the columns.
    pub errors: usize,
}

/// An open file and its rows.
#[derive(Debug)]
pub struct Table {
    pub rows: Vec<Row>,
    path: PathBuf,
    file: File,
}

impl Header {
    fn text(&self) -> String {
        format!("{OWN}{}\n{}\n", self.stamp, line(&self.columns))
    }

    /// Rows of a file's text, each with its line; a last line that a kill cut short is none.
    fn rows(&self, path: &Path, text: &str) -> Result<Vec<(usize, Row)>, String> {
        let refuse = |why: &str| format!("{} {why}; --force overwrites it, --out names another file", path.display());
        let mut lines = text.split_inclusive('\n').zip(1..);
        if lines.next().is_none_or(|(first, _)| first != format!("{OWN}{}\n", self.stamp)) {
            return Err(refuse("is a study of another scene, or the scene or its reference has changed since"));
        }
        if lines.next().is_none_or(|(second, _)| cells(second.trim_end()) != self.columns) {
            return Err(refuse("is a study of other paths or expectations"));
        }
        let whole = lines.filter(|(line, _)| line.ends_with('\n'));
        let row = |(line, number): (&str, usize)| match Row::from_cells(
            cells(line.trim_end_matches('\n')),
            self.columns.len(),
            self.errors,
        ) {
            Ok(row) => Ok((number, row)),
            Err(why) => Err(format!("{}:{number}: {why}; --force overwrites the file", path.display())),
        };
        whole.map(row).collect()
    }
}

impl Table {
    /// Opens the file of a study, or makes it.
    ///
    /// # Errors
    /// One sentence where the file is of another study, holds a run that is not `wanted`, or cannot be written.
    pub fn open(path: &Path, header: &Header, wanted: &dyn Fn(&Row) -> bool, force: bool) -> Result<Self, String> {
        let failed = |error: std::io::Error| format!("cannot write {}: {error}", path.display());
        let found = existing(path)?;
        let text = if force { String::new() } else { found };
        // A kill may have cut the header itself.
        let fresh = header.text().starts_with(&text);
        let rows = if fresh { Vec::new() } else { header.rows(path, &text)? };
        refuse_other_runs(path, &rows, wanted)?;
        if fresh {
            std::fs::create_dir_all(path.parent().unwrap_or(Path::new("."))).map_err(failed)?;
            crate::output::durable::put(path, &[header.text().as_bytes()])?;
        }
        let file = OpenOptions::new().append(true).open(path).map_err(failed)?;
        if !fresh {
            file.set_len(text.rfind('\n').map_or(0, |end| end as u64 + 1)).map_err(failed)?;
        }
        Ok(Self { rows: rows.into_iter().map(|(_, row)| row).collect(), path: path.into(), file })
    }

    /// Whether the run has its row.
    pub fn holds(&self, key: &[String]) -> bool {
        self.rows.iter().any(|row| row.key == key)
    }

    /// Appends a row; it is with the operating system when this returns.
    pub fn append(&mut self, row: Row) -> Result<&Row, String> {
        // One call for the whole line: a kill leaves it out or leaves it whole.
        let written = self.file.write_all((line(&row.cells()) + "\n").as_bytes());
        written.map_err(|error| format!("cannot write {}: {error}", self.path.display()))?;
        self.rows.push(row);
        Ok(&self.rows[self.rows.len() - 1])
    }
}

/// What every study's file begins with.
const OWN: &str = "# lithosph ";

/// The text of a study's file, empty where there is none. What is something else is not overwritten even if forced.
fn existing(path: &Path) -> Result<String, String> {
    match std::fs::read_to_string(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(String::new()),
        Err(error) => Err(format!("cannot read {}: {error}", path.display())),
        Ok(text) if text.starts_with(OWN) || OWN.starts_with(&text) => Ok(text),
        Ok(_) => Err(format!("{} is there and no study wrote it: --out names another file", path.display())),
    }
}

/// A longer matrix goes on with a shorter one's rows; a shorter one would mix its table with runs that it does not name.
fn refuse_other_runs(path: &Path, rows: &[(usize, Row)], wanted: &dyn Fn(&Row) -> bool) -> Result<(), String> {
    let Some((number, row)) = rows.iter().find(|(_, row)| !wanted(row)) else { return Ok(()) };
    let key = row.key.join(", ");
    let place = path.display();
    Err(format!("{place}:{number}: {key} is not in this matrix; --force overwrites the file, --out names another"))
}

/// Cells as a line without its end; a cell with a comma or a quote goes in quotes.
pub fn line(cells: &[String]) -> String {
    let quoted = |cell: &String| match cell.contains([',', '"']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.clone(),
    };
    cells.iter().map(quoted).collect::<Vec<_>>().join(",")
}

/// Cells of a line.
pub fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted, mut letters) = (vec![String::new()], false, line.chars().peekable());
    while let Some(letter) = letters.next() {
        let last = cells.len() - 1;
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => cells[last].extend(letters.next()),
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells[last].push(letter),
        }
    }
    cells
}
