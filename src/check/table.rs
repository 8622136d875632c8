//! Rows as a table of text.

use super::{Row, Verdict};
use crate::output::csv::shortest;
use crate::scene::file::{Expect, Statement};

/// The truth in words.
pub fn expected(expect: &Expect) -> String {
    match (expect.between, expect.value, &expect.reference) {
        (Some([low, high]), ..) => format!("{} .. {}", shortest(low), shortest(high)),
        (None, Some(value), _) => shortest(value),
        (None, None, Some(reference)) => reference.clone(),
        (None, None, None) => "-".into(),
    }
}

/// The tolerance in words; of what is not the truth, about what was seen.
pub fn tolerance(expect: &Expect) -> String {
    let Some(tolerance) = expect.tolerance else { return "range".into() };
    let about = match (expect.kind, expect.seen) {
        (Statement::Truth, _) | (_, None) => String::new(),
        (_, Some(seen)) if expect.reference.is_some() && expect.relative => format!("{} ", percent(seen)),
        (_, Some(seen)) => format!("{} ", shortest(seen)),
    };
    let width = if expect.relative { percent(tolerance) } else { shortest(tolerance) };
    if tolerance == 0.0 { format!("{about}exact") } else { format!("{about}±{width}") }
}

/// A fraction in at most two digits: in percent where it is not tiny.
fn percent(fraction: f64) -> String {
    if fraction == 0.0 {
        return "0".into();
    }
    let two: f64 = format!("{fraction:.1e}").parse().unwrap_or(fraction);
    if two.abs() < 1e-5 { format!("{two:e}") } else { format!("{} %", (1e6 * two).round() / 1e4) }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Miss => "MISS",
        Verdict::Failure => "failure",
        Verdict::Shortfall => "shortfall",
        Verdict::Pinned => "pinned",
        Verdict::Unfinished => "not run",
    }
}

const HEAD: [&str; 9] = ["scene", "observable", "seen", "expected", "error", "of", "tolerance", "verdict", "source"];

fn cells(row: &Row) -> [String; 9] {
    let seen = row.seen.map_or_else(|| "-".into(), |seen| format!("{seen:.6e}"));
    let notes = [(!row.note.is_empty()).then(|| row.note.clone()), row.wide.as_ref().map(|wide| format!("TOO WIDE: {wide}"))];
    let source = std::iter::once(row.source.clone()).chain(notes.into_iter().flatten()).collect::<Vec<_>>().join("; ");
    [
        format!("{}{}", row.scene, if row.slow { " *" } else { "" }),
        row.name.clone(),
        seen,
        row.expected.clone(),
        row.error.map_or_else(|| "-".into(), percent),
        row.of.clone(),
        row.tolerance.clone(),
        verdict(row.verdict).into(),
        source,
    ]
}

/// The table as text: a line of heads, a line for each row, and what there is of each verdict.
pub fn text(rows: &[Row]) -> String {
    let lines: Vec<[String; 9]> = std::iter::once(HEAD.map(String::from)).chain(rows.iter().map(cells)).collect();
    let width = |k: usize| lines.iter().map(|line| line[k].chars().count()).max().unwrap_or(0);
    let widths: [usize; 9] = std::array::from_fn(width);
    let mut out = String::new();
    for line in &lines {
        for (k, cell) in line.iter().enumerate() {
            // Numbers end in one column, words begin in one.
            let blank = " ".repeat(widths[k] - cell.chars().count());
            out += &match k {
                8 => cell.clone(),
                2..=4 => format!("{blank}{cell} "),
                _ => format!("{cell}{blank} "),
            };
        }
        out.truncate(out.trim_end().len());
        out.push('\n');
    }
    out + &sums(rows)
}

fn sums(rows: &[Row]) -> String {
    let count = |wanted: Verdict| rows.iter().filter(|row| row.verdict == wanted).count();
    let held = [Verdict::Pass, Verdict::Failure, Verdict::Shortfall, Verdict::Pinned, Verdict::Unfinished];
    let mut counts: Vec<String> = Vec::new();
    for held in held.into_iter().filter(|&held| count(held) > 0) {
        counts.push(format!("{} {}", count(held), verdict(held)));
    }
    counts.push(format!("{} missed", count(Verdict::Miss)));
    let wide = rows.iter().filter(|row| row.wide.is_some()).count();
    let wide = if wide > 0 { format!("; {wide} tolerances too wide") } else { String::new() };
    format!("{} expectations: {}{wide}\n", rows.len(), counts.join(", "))
}
