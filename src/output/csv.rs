//! Columns of numbers over time, one flushed row an output, and reference tables read back.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;

/// A comma-separated file that grows by one row at a time; the first column is time.
#[derive(Debug)]
pub struct Series {
    columns: Vec<String>,
    file: File,
}

impl Series {
    /// Starts a new file with a header row.
    pub fn create(path: &Path, columns: &[String]) -> Result<Self, String> {
        if let Some(bad) = columns.iter().find(|c| c.is_empty() || c.contains([',', '\n', '\r', '#', '"'])) {
            return Err(format!("{bad:?} cannot be the name of a column"));
        }
        let mut file = File::create(path).map_err(|error| failed("write", path, &error))?;
        let header = columns.join(",") + "\n";
        file.write_all(header.as_bytes()).map_err(|error| failed("write", path, &error))?;
        Ok(Self { columns: columns.to_vec(), file })
    }

    /// Continues a file, dropping a last row that a kill cut short.
    pub fn open_append(path: &Path) -> Result<Self, String> {
        let text = load(path)?;
        let columns = header(&text).ok_or_else(|| format!("{} has no header row", path.display()))?;
        let file = OpenOptions::new().append(true).open(path).map_err(|error| failed("write", path, &error))?;
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        file.set_len(whole as u64).map_err(|error| failed("write", path, &error))?;
        Ok(Self { columns, file })
    }

    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// Appends one row; it is with the operating system when this returns.
    pub fn row(&mut self, values: &[f64]) -> Result<(), String> {
        if values.len() != self.columns.len() {
            return Err(format!("a row of {} values for {} columns", values.len(), self.columns.len()));
        }
        let line = values.iter().map(|&value| shortest(value)).collect::<Vec<_>>().join(",") + "\n";
        // One call for the whole line: a kill leaves it out or leaves it whole.
        self.file.write_all(line.as_bytes()).map_err(|error| format!("cannot write a row: {error}"))
    }
}

/// The fewest digits that read back as the same f64, plain where that is short.
pub fn shortest(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || (1e-4..1e7).contains(&magnitude) || !value.is_finite() { format!("{value}") } else { format!("{value:e}") }
}

/// Drops every row later than `time`, keeping header and comments: the state of the file when the
/// checkpoint of that time was written.
pub fn truncate_after(path: &Path, time: f64) -> Result<(), String> {
    let text = load(path)?;
    let kept = |line: &&str| {
        line.ends_with('\n') && line.split(',').next().and_then(|first| first.trim().parse().ok()).is_none_or(|t: f64| t <= time)
    };
    let shorter: String = text.split_inclusive('\n').filter(kept).collect();
    let part = super::aside(path);
    std::fs::write(&part, shorter).map_err(|error| failed("write", &part, &error))?;
    std::fs::rename(&part, path).map_err(|error| failed("write", path, &error))
}

/// Column names and rows of a table with a header row; `#` starts a comment line.
///
/// A last line without its newline is taken where it is whole (tables typed by hand) and left out
/// where it is not (a run that was killed).
pub fn read(path: &Path) -> Result<(Vec<String>, Vec<Vec<f64>>), String> {
    let text = load(path)?;
    let columns = header(&text).ok_or_else(|| format!("{} has no header row", path.display()))?;
    let mut rows = Vec::new();
    for (number, line) in content(&text).skip(1) {
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
    std::fs::read_to_string(path).map_err(|error| failed("read", path, &error))
}

fn failed(verb: &str, path: &Path, error: &std::io::Error) -> String {
    format!("cannot {verb} {}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> std::path::PathBuf {
        std::env::temp_dir().join(format!("lithosph-{name}-{}.csv", std::process::id()))
    }

    fn names() -> Vec<String> {
        vec!["time".into(), "energy".into()]
    }

    #[test]
    fn rows_come_back_bit_for_bit() {
        let path = scratch("bits");
        let rows = [[0.0, 1.0 / 3.0], [1e-9, -6.02e23], [0.1 + 0.2, f64::MIN_POSITIVE], [4.0, f64::INFINITY]];
        let mut series = Series::create(&path, &names()).unwrap();
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
        std::fs::write(&path, "# note\ntime,energy\n0,1\n1,2\n2,").unwrap();
        assert_eq!(read(&path).unwrap().1, [[0.0, 1.0], [1.0, 2.0]]);
        let mut series = Series::open_append(&path).unwrap();
        assert_eq!(series.columns(), names());
        series.row(&[2.0, 3.0]).unwrap();
        assert_eq!(read(&path).unwrap().1, [[0.0, 1.0], [1.0, 2.0], [2.0, 3.0]]);
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn truncation_keeps_rows_up_to_the_checkpoint() {
        let path = scratch("cut");
        std::fs::write(&path, "# note\ntime,energy\n0,1\n1,2\n2,3\n2.5").unwrap();
        truncate_after(&path, 1.0).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "# note\ntime,energy\n0,1\n1,2\n");
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
        assert!(Series::create(&scratch("name"), &["a,b".into()]).unwrap_err().contains("\"a,b\""));
    }
}
