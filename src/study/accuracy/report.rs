//! What a study says: a line for each run that ends, and the table at the end.

use super::front::{Best, Expected, best};
use super::row::{OK, Row};
use indicatif::HumanDuration;
use std::io::IsTerminal;
use std::time::Instant;

/// Lines on a terminal while a study runs.
pub struct Progress {
    visible: bool,
    begin: Instant,
    total: usize,
    /// Runs with a row, those of an earlier start included.
    done: usize,
    ran: u32,
}

impl Progress {
    pub fn new(total: usize, done: usize) -> Self {
        Self { visible: std::io::stderr().is_terminal(), begin: Instant::now(), total, done, ran: 0 }
    }

    /// Tells of a run that has ended.
    pub fn tell(&mut self, row: &Row) {
        (self.done, self.ran) = (self.done + 1, self.ran + 1);
        if !self.visible {
            return;
        }
        let left = self.begin.elapsed() / self.ran * (self.total - self.done) as u32;
        let cost = row.cpu_seconds().map_or_else(String::new, |seconds| format!(", {seconds:.2} s"));
        let (done, total, status) = (self.done, self.total, &row.status);
        eprintln!("{done}/{total}  {}: {status}{cost}; {} left", row.key.join(", "), HumanDuration(left));
    }
}

/// The settings by rising cost, the front marked, then those that failed.
pub fn text(paths: &[String], expected: &[Expected], rows: &[Row]) -> String {
    let best = best(rows, expected);
    let mut lines = vec![titles(paths, expected)];
    lines.extend(best.iter().map(|best| cells(best, expected.len())));
    let mut out = aligned(&lines, paths.len() + 2);
    for row in rows.iter().filter(|row| row.status != OK) {
        out += &format!("{}: {}\n", row.key.join(", "), row.status);
    }
    let error = if expected.len() > 1 { "error/tolerance, the largest over all errors" } else { "error" };
    out + &format!("* on the Pareto front of cpu_seconds and {error}")
}

fn titles(paths: &[String], expected: &[Expected]) -> Vec<String> {
    let fixed = ["backend", "particles", "cpu_seconds"].map(String::from);
    let errors = expected.iter().map(|expected| format!("error_{}", expected.name));
    let largest = (expected.len() > 1).then(|| "error/tolerance".to_string());
    [String::new()].into_iter().chain(paths.iter().cloned()).chain(fixed).chain(errors).chain(largest).collect()
}

fn cells(best: &Best, expected: usize) -> Vec<String> {
    let error = |error: Option<f64>| error.map_or_else(|| "-".into(), |error| format!("{error:.2e}"));
    let row = best.row;
    let (values, run) = row.subject().split_at(row.subject().len() - 2);
    let mut cells = vec![if best.on_front { "*" } else { "" }.to_string()];
    cells.extend(values.iter().cloned().chain([run.join(" ")]));
    cells.extend(row.cost.map(|cost| [format!("{}", cost[0]), format!("{:.3}", cost[4])]).into_iter().flatten());
    cells.extend(row.errors.iter().map(|&number| error(number)));
    cells.extend((expected > 1).then(|| error(best.error)));
    cells
}

/// Columns side by side, words to the left, and to the right what comes after them.
pub fn aligned(lines: &[Vec<String>], words: usize) -> String {
    let width = |k: usize| lines.iter().map(|line| line[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..lines[0].len()).map(width).collect();
    let cell = |(k, cell): (usize, &String)| match k < words {
        true => format!("{cell:<0$}", widths[k]),
        false => format!("{cell:>0$}", widths[k]),
    };
    let line = |line: &Vec<String>| line.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ").trim_end().to_string();
    lines.iter().map(|cells| line(cells) + "\n").collect()
}
