//! What an ablation says: a line for each piece, what the scene does not need, and the smallest model.

use super::judge::{Judge, Verdict};
use super::piece::{Piece, Sort};
use super::{Found, Request};
use crate::scene::Scene;
use crate::study::accuracy::recommend::quoted;
use crate::study::accuracy::report::aligned;
use crate::study::accuracy::row::Row;

pub const TITLES: [&str; 8] = [
    "without",
    "verdict",
    "CPU saved",
    "updates saved",
    "bytes saved",
    "error/tolerance",
    "of",
    "largest change of an observable",
];

/// The table and the sentences below it.
pub fn text(scene: &Scene, request: &Request, found: &Found) -> String {
    let mut lines = vec![TITLES.map(String::from).to_vec(), cells("(nothing)", "", &found.judge, &found.judge.whole)];
    lines.extend(found.rows.iter().map(|(piece, row)| cells(&piece.name, &found.says(piece, row), &found.judge, row)));
    if let Some((_, row)) = &found.smallest {
        lines.push(cells("the smallest model", "confirmed by its run", &found.judge, row));
    }
    aligned(&lines, 2) + "\n" + &sentences(scene, request, found).join("\n")
}

/// A line of the table under [`TITLES`].
pub fn cells(name: &str, verdict: &str, judge: &Judge, row: &Row) -> Vec<String> {
    let saved = judge.saved(row).map(|saved| saved.map(|part| format!("{:.0} %", 100.0 * part)));
    let saved = saved.unwrap_or_else(|| std::array::from_fn(|_| "-".into()));
    let (of, worst) = judge.worst(row).map_or_else(Default::default, |(name, share)| (name, number(share)));
    let largest = judge.largest_change(row);
    let change = largest.map_or_else(|| "-".into(), |(name, change)| format!("{} {name}", percent(change)));
    let [cpu, updates, bytes] = saved;
    let worst = if worst.is_empty() { "-".into() } else { worst };
    vec![name.into(), verdict.into(), cpu, updates, bytes, worst, of, change]
}

fn number(value: f64) -> String {
    if value == 0.0 || (0.01..1000.0).contains(&value) { format!("{value:.2}") } else { format!("{value:.1e}") }
}

fn percent(part: f64) -> String {
    format!("{} %", number(100.0 * part))
}

/// What the scene does not need, and the smallest model with the options that make it.
pub fn sentences(scene: &Scene, request: &Request, found: &Found) -> Vec<String> {
    let label = scene.label();
    let mut list = Vec::new();
    for (piece, row) in &found.rows {
        let why = match found.judge.verdict(row) {
            _ if !found.judge.is_cheaper(piece.sort, row) => continue,
            Verdict::Idle => "no observable knows of it",
            Verdict::Spare => "all that is expected stays within tolerance without it",
            _ => continue,
        };
        let name = &piece.name;
        list.push(match piece.sort {
            Sort::Named => format!("{label} carries {name}, which it does not need: {why}."),
            Sort::Reduced => format!("{label} would do with less: {name}."),
        });
    }
    match &found.smallest {
        None => list.push(format!("{label} is the smallest model within tolerance: no piece of it may go.")),
        Some((piece, row)) => list.extend(smallest(&label, request, found, piece, row)),
    }
    list
}

fn smallest(label: &str, request: &Request, found: &Found, piece: &Piece, row: &Row) -> Vec<String> {
    let left = found.judge.saved(row).unwrap_or_default().map(|part| format!("{:.0} %", 100.0 * (1.0 - part)));
    let (name, share) = found.judge.worst(row).unwrap_or_default();
    let [cpu, updates, bytes] = left;
    vec![
        format!(
            "Smallest model of {label} within tolerance, run to confirm it: {cpu} of the processor time, {updates} of the \
             particle-updates, {bytes} of the bytes; {name} at {} of its tolerance. Without: {}.",
            number(share),
            piece.name
        ),
        command(request, piece),
    ]
}

/// The command line that runs a scene without a piece.
fn command(request: &Request, piece: &Piece) -> String {
    let variant = request.variant.iter().map(|variant| format!(" --variant {variant}"));
    let set = request.set.iter().chain(&piece.overrides).map(|text| format!(" --set {}", quoted(text)));
    format!("lithosph run {}{}", request.scene.display(), variant.chain(set).collect::<String>())
}
