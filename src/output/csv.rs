//! Columns of numbers over time, one row an output, and reference tables read back.

use super::durable::failed;
use super::manifest::Content;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Names of columns, and rows of as many numbers.
pub type Rows = (Vec<String>, Vec<Vec<f64>>);

/// A comma-separated file that grows by one row at a time; the first column is time.
///
/// A run that goes on from a checkpoint finds the rows again that were written after it. They stay where they are as long as
/// the new ones are the same, and are cut off at the first that is not.
#[derive(Debug)]
pub struct Series {
    path: PathBuf,
    columns: usize,
    file: File,
    hasher: blake3::Hasher,
    /// What the file holds behind the last row.
    ahead: Vec<u8>,
}

impl Series {
    /// Starts a file with a header row, over what may be there of an earlier attempt.
    pub fn begin(path: &Path, columns: &[String]) -> Result<Self, String> {
        let header = header_line(columns)?;
        let opened = OpenOptions::new().append(true).create(true).open(path);
        let file = opened.map_err(|error| failed(path, &error))?;
        let ahead = fs::read(path).map_err(|error| unread(path, &error))?;
        let mut series = Self { path: path.into(), columns: columns.len(), file, hasher: blake3::Hasher::new(), ahead };
        series.line(&header)?;
        Ok(series)
    }

    /// Goes on behind what the file was at a time; gives the columns and rows up to there. The error says what is wrong with it.
    pub fn reopen(path: &Path, then: Content) -> Result<(Self, Rows), String> {
        let bytes = fs::read(path).map_err(|error| unread(path, &error))?;
        let length = usize::try_from(then.bytes).unwrap_or(usize::MAX);
        let Some((before, ahead)) = bytes.split_at_checked(length) else {
            return Err(format!("{} lacks rows that were written", path.display()));
        };
        if Content::of(&[before]) != then {
            return Err(format!("{} is not as it was written", path.display()));
        }
        let rows = table(path, &String::from_utf8_lossy(before))?;
        let opened = OpenOptions::new().append(true).open(path);
        let file = opened.map_err(|error| failed(path, &error))?;
        let mut hasher = blake3::Hasher::new();
        hasher.update(before);
        Ok((Self { path: path.into(), columns: rows.0.len(), file, hasher, ahead: ahead.to_vec() }, rows))
    }

    /// Appends one row; it is with the operating system when this returns.
    pub fn row(&mut self, values: &[f64]) -> Result<(), String> {
        if values.len() != self.columns {
            return Err(format!("a row of {} values for {} columns", values.len(), self.columns));
        }
        self.line(&row_line(values))
    }

    fn line(&mut self, line: &str) -> Result<(), String> {
        if self.ahead.starts_with(line.as_bytes()) {
            self.ahead.drain(..line.len());
        } else {
            self.cut()?;
            // One call for the whole line: a kill leaves it out or leaves it whole.
            self.file.write_all(line.as_bytes()).map_err(|error| failed(&self.path, &error))?;
        }
        self.hasher.update(line.as_bytes());
        Ok(())
    }

    /// Takes off what lies behind the last row.
    pub fn cut(&mut self) -> Result<(), String> {
        if !self.ahead.is_empty() {
            self.file.set_len(self.hasher.count()).map_err(|error| failed(&self.path, &error))?;
            self.ahead.clear();
        }
        Ok(())
    }

    /// What the file consists of up to the last row, once that is on the disk.
    pub fn sync(&mut self) -> Result<Content, String> {
        self.file.sync_data().map_err(|error| failed(&self.path, &error))?;
        Ok(Content { hash: self.hasher.finalize(), bytes: self.hasher.count() })
    }
}

fn header_line(columns: &[String]) -> Result<String, String> {
    match columns.iter().find(|c| c.is_empty() || c.contains([',', '\n', '\r', '#', '"'])) {
        Some(bad) => Err(format!("{bad:?} cannot be the name of a column")),
        None => Ok(columns.join(",") + "\n"),
    }
}

fn row_line(values: &[f64]) -> String {
    values.iter().map(|&value| shortest(value)).collect::<Vec<_>>().join(",") + "\n"
}

/// The text of a whole table.
pub fn text(columns: &[String], rows: impl IntoIterator<Item = Vec<f64>>) -> Result<String, String> {
    let mut text = header_line(columns)?;
    for row in rows {
        if row.len() != columns.len() {
            return Err(format!("a row of {} values for {} columns", row.len(), columns.len()));
        }
        text += &row_line(&row);
    }
    Ok(text)
}

/// The fewest digits that read back as the same f64, plain where that is short.
pub fn shortest(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || (1e-4..1e7).contains(&magnitude) || !value.is_finite() { format!("{value}") } else { format!("{value:e}") }
}

/// Column names and rows of a table with a header row; `#` starts a comment line.
///
/// A last line without its newline is taken where it is whole (tables typed by hand) and left out
/// where it is not (a run that was killed).
pub fn read(path: &Path) -> Result<Rows, String> {
    table(path, &load(path)?)
}

fn table(path: &Path, text: &str) -> Result<Rows, String> {
    let columns = header(text).ok_or_else(|| format!("{} has no header row", path.display()))?;
    let mut rows = Vec::new();
    for (number, line) in content(text).skip(1) {
        match parse(line, columns.len()) {
            Ok(row) => rows.push(row),
            Err(_) if number == text.lines().count() && !text.ends_with('\n') => {}
            Err(why) => return Err(format!("{}:{number}: {why}", path.display())),
        }
    }
    Ok((columns, rows))
}

/// Lines that are neither blank nor comment, with their numbers from 1.
fn content(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let numbered = text.lines().enumerate().map(|(k, line)| (k + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

/// The names in the first line, or nothing where that line holds numbers.
fn header(text: &str) -> Option<Vec<String>> {
    let (_, line) = content(text).next()?;
    let names: Vec<String> = line.split(',').map(|name| name.trim().to_string()).collect();
    names[0].parse::<f64>().is_err().then_some(names)
}

fn parse(line: &str, columns: usize) -> Result<Vec<f64>, String> {
    let number = |field: &str| field.trim().parse().map_err(|_| format!("{:?} is not a number", field.trim()));
    let row = line.split(',').map(number).collect::<Result<Vec<f64>, _>>()?;
    if row.len() == columns { Ok(row) } else { Err(format!("{} values for {columns} columns", row.len())) }
}

fn load(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| unread(path, &error))
}

fn unread(path: &Path, error: &std::io::Error) -> String {
    format!("cannot read {}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> std::path::PathBuf {
        std::env::temp_dir().join(format!("lithosph-{name}-{}.csv", std::process::id()))
    }

    /// A file of which nothing is there yet.
    fn begun(path: &Path, columns: &[String]) -> Result<Series, String> {
        let _ = std::fs::remove_file(path);
        Series::begin(path, columns)
    }

    fn names() -> Vec<String> {
        vec!["time".into(), "energy".into()]
    }

    #[test]
    fn rows_come_back_bit_for_bit() {
        let path = scratch("bits");
        let rows = [[0.0, 1.0 / 3.0], [1e-9, -6.02e23], [0.1 + 0.2, f64::MIN_POSITIVE], [4.0, f64::INFINITY]];
        let mut series = begun(&path, &names()).unwrap();
        for row in &rows {
            series.row(row).unwrap();
        }
        assert!(series.row(&[1.0]).is_err());
        let (columns, back) = read(&path).unwrap();
        assert_eq!(columns, names());
        assert_eq!(back, rows.map(|row| row.to_vec()));
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn a_half_written_row_is_left_out_and_overwritten() {
        let path = scratch("half");
        let mut series = begun(&path, &names()).unwrap();
        (0..2).for_each(|k| series.row(&[f64::from(k), 1.0]).unwrap());
        let then = series.sync().unwrap();
        std::fs::write(&path, "time,energy\n0,1\n1,1\n2,").unwrap();
        assert_eq!(read(&path).unwrap().1, [[0.0, 1.0], [1.0, 1.0]]);
        let (mut series, (columns, rows)) = Series::reopen(&path, then).unwrap();
        assert_eq!((columns, rows), (names(), vec![vec![0.0, 1.0], vec![1.0, 1.0]]));
        series.row(&[2.0, 3.0]).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "time,energy\n0,1\n1,1\n2,3\n");
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn rows_that_come_again_stay_and_others_are_cut_off() {
        let path = scratch("again");
        let mut series = begun(&path, &names()).unwrap();
        series.row(&[0.0, 1.0]).unwrap();
        let then = series.sync().unwrap();
        (1..5).for_each(|k| series.row(&[f64::from(k), 2.0]).unwrap());
        let whole = std::fs::read_to_string(&path).unwrap();
        let (mut series, ..) = Series::reopen(&path, then).unwrap();
        series.row(&[1.0, 2.0]).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), whole);
        series.row(&[2.0, 7.0]).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "time,energy\n0,1\n1,2\n2,7\n");
        let mut begun = Series::begin(&path, &names()).unwrap();
        begun.row(&[0.0, 1.0]).unwrap();
        assert_eq!(read(&path).unwrap().1.len(), 3);
        begun.cut().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "time,energy\n0,1\n");
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn rows_that_are_missing_or_changed_are_told() {
        let path = scratch("missing");
        let mut series = begun(&path, &names()).unwrap();
        (0..3).for_each(|k| series.row(&[f64::from(k), 1.0]).unwrap());
        let then = series.sync().unwrap();
        std::fs::write(&path, "time,energy\n0,1\n1,1\n").unwrap();
        assert!(Series::reopen(&path, then).unwrap_err().contains("lacks rows"));
        std::fs::write(&path, "time,energy\n0,1\n1,2\n2,1\n").unwrap();
        assert!(Series::reopen(&path, then).unwrap_err().contains("not as it was written"));
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn tables_typed_by_hand_are_read() {
        let path = scratch("hand");
        std::fs::write(&path, "# source: a paper\r\n\r\n t , e \r\n 0 , 1e3\r\n# more\r\n1,2").unwrap();
        let (columns, rows) = read(&path).unwrap();
        assert_eq!(columns, ["t", "e"]);
        assert_eq!(rows, [[0.0, 1000.0], [1.0, 2.0]]);
        std::fs::write(&path, "t,e\n0,one\n1,2\n").unwrap();
        assert!(read(&path).unwrap_err().contains(":2: \"one\" is not a number"));
        std::fs::write(&path, "0,1\n").unwrap();
        assert!(read(&path).unwrap_err().contains("no header"));
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn names_that_would_break_the_table_are_refused() {
        assert!(begun(&scratch("name"), &["a,b".into()]).unwrap_err().contains("\"a,b\""));
    }
}
