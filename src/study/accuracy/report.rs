//! What a study says: a line for each run that ends, and the table at the end.

use super::front::{Best, best, cheapest};
use super::measure::{Measures, brief};
use super::names::Names;
use super::row::{Cost, OK, Row};
use crate::complain::complain;
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
        let cost = row.cost_of(Cost::CpuSeconds).map_or_else(String::new, |seconds| format!(", {seconds:.2} s"));
        let (done, total, status) = (self.done, self.total, &row.status);
        complain(&format!("{done}/{total}  {}: {status}{cost}; {} left", row.key.join(", "), HumanDuration(left)));
    }
}

/// The settings by rising cost, the front marked, those that failed, and the cheapest for each error.
pub fn text(paths: &[String], measures: &Measures, rows: &[Row]) -> String {
    let mut out = aligned(&settings(paths, measures, rows), paths.len() + 2);
    for row in rows.iter().filter(|row| row.status != OK) {
        out += &format!("{}: {}\n", row.key.join(", "), row.status);
    }
    let judged = measures.judged_by();
    out += &format!("* on the Pareto front of cpu_seconds and {judged}, + on that of particle_updates and {judged}\n");
    out + &aligned(&goals(paths, measures, rows), 2)
}

/// A line of titles, and one for each setting by rising CPU seconds.
pub fn settings(paths: &[String], measures: &Measures, rows: &[Row]) -> Vec<Vec<String>> {
    let updates = best(rows, measures, Cost::ParticleUpdates);
    let cheap = |row: &Row| updates.iter().any(|best| best.on_front && best.row.subject() == row.subject());
    let line = |best: &Best| {
        let mark = [if best.on_front { "*" } else { "" }, if cheap(best.row) { "+" } else { "" }].concat();
        cells(best, mark, measures)
    };
    let best = best(rows, measures, Cost::CpuSeconds);
    [titles(paths, measures)].into_iter().chain(best.iter().map(line)).collect()
}

fn titles(paths: &[String], measures: &Measures) -> Vec<String> {
    let fixed = ["backend", "particles", "particle_updates", "cpu_seconds"].map(String::from);
    let errors = measures.expected.iter().map(|expected| format!("error_{}", expected.name));
    let judged = Some(measures.judged_by()).filter(|_| !measures.judged_by_own());
    [String::new()].into_iter().chain(paths.iter().cloned()).chain(fixed).chain(errors).chain(judged).collect()
}

fn cells(best: &Best, mark: String, measures: &Measures) -> Vec<String> {
    let error = |error: Option<f64>| error.map_or_else(|| "-".into(), |error| format!("{error:.2e}"));
    let row = best.row;
    let (values, run) = row.subject().split_at(row.subject().len() - 2);
    let cost = |cost: [f64; 8]| [format!("{}", cost[0]), format!("{:.3e}", cost[3]), format!("{:.3}", cost[4])];
    let mut cells = vec![mark];
    cells.extend(values.iter().cloned().chain([run.join(" ")]));
    cells.extend(row.cost.map(cost).into_iter().flatten());
    cells.extend(row.errors[..measures.expected.len()].iter().map(|&number| error(number)));
    cells.extend((!measures.judged_by_own()).then(|| best.error.map_or_else(|| "-".into(), |error| measures.shown(error))));
    cells
}

/// A line of titles, and the cheapest setting for each error, by CPU seconds and by particle-updates.
pub fn goals(paths: &[String], measures: &Measures, rows: &[Row]) -> Vec<Vec<String>> {
    let names = Names::new(paths, rows);
    let columns = [Cost::CpuSeconds, Cost::ParticleUpdates].map(|cost| (cost, best(rows, measures, cost)));
    let titles = columns.iter().flat_map(|(cost, _)| [format!("cheapest by {}", cost.about()), cost.about()]);
    let titles = ["error up to".to_string()].into_iter().chain(titles).collect();
    let line = |(goal, words): (f64, String)| {
        let found = columns.iter().flat_map(|(cost, best)| match cheapest(best, goal) {
            Some(best) => [names.of(best.row), best.row.cost_of(*cost).map_or_else(String::new, brief)],
            None => ["none".to_string(), "-".to_string()],
        });
        [words].into_iter().chain(found).collect()
    };
    [titles].into_iter().chain(measures.goals().into_iter().map(line)).collect()
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
