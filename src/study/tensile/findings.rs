//! What a part of the study hands on: exhibits (a table, pictures, words) and statements about a published figure.

use crate::study::chart::{Picture, Section, Table};
use std::path::Path;

/// What the thesis says at one place, what comes out here, and whether they agree.
#[derive(Debug, Clone, PartialEq)]
pub struct Statement {
    /// Figure, table or section, and page.
    pub place: &'static str,
    pub published: String,
    pub found: String,
    pub agrees: bool,
}

impl Statement {
    pub fn new(place: &'static str, published: impl Into<String>, found: impl Into<String>, agrees: bool) -> Self {
        Self { place, published: published.into(), found: found.into(), agrees }
    }
    pub fn verdict(&self) -> &'static str {
        if self.agrees { "agrees" } else { "differs" }
    }
}

/// A section of the page, and the files of the same name.
#[derive(Debug, Clone, Default)]
pub struct Exhibit {
    /// Stem of its files.
    pub stem: String,
    pub heading: String,
    pub text: Vec<String>,
    pub pictures: Vec<Picture>,
    pub table: Option<Table>,
}

impl Exhibit {
    /// Writes `stem.csv`, and `stem.svg` and `stem.png` of its pictures, three side by side (further ones as `stem-2.svg`).
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), String> {
        if let Some(table) = &self.table {
            write_csv(table, &folder.join(format!("{}.csv", self.stem)))?;
        }
        for (k, row) in self.pictures.chunks(3).enumerate() {
            let stem = if k == 0 { self.stem.clone() } else { format!("{}-{}", self.stem, k + 1) };
            Picture::Row(row.to_vec()).write(&folder.join(stem))?;
        }
        Ok(())
    }

    pub fn section(self) -> Section {
        Section { heading: self.heading, text: self.text, pictures: self.pictures, images: Vec::new(), table: self.table }
    }
}

/// What one part found.
#[derive(Debug, Clone, Default)]
pub struct Findings {
    pub exhibits: Vec<Exhibit>,
    pub statements: Vec<Statement>,
}

impl Findings {
    pub fn add(&mut self, other: Findings) {
        self.exhibits.extend(other.exhibits);
        self.statements.extend(other.statements);
    }
}

/// Statements as a table.
pub fn listed(statements: &[Statement]) -> Table {
    let row = |s: &Statement| vec![s.place.to_string(), s.published.clone(), s.found.clone(), s.verdict().to_string()];
    Table { columns: table_columns(&["where", "Strand 2010", "here", "verdict"]), rows: statements.iter().map(row).collect() }
}

pub fn table_columns(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| name.to_string()).collect()
}

pub fn write_csv(table: &Table, path: &Path) -> Result<(), String> {
    let cell = |text: &String| {
        if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.clone() }
    };
    let line = |cells: &Vec<String>| cells.iter().map(cell).collect::<Vec<_>>().join(",") + "\n";
    let text: String = std::iter::once(&table.columns).chain(&table.rows).map(line).collect();
    crate::output::durable::put(path, &[text.as_bytes()])
}

/// Within a part of the published number.
pub fn near(found: f64, published: f64, part: f64) -> bool {
    (found / published - 1.0).abs() < part
}
