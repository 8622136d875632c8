//! Ablation: what a scene carries is taken away piece by piece, each time the scene runs, and its numbers tell whether
//! it needed the piece; then the smallest model within tolerance is put together, and run to confirm it.
//!
//! A piece is physics or numerics that the scene names ([`named`]), or a reduction: coarser, shorter, narrower, of a
//! dimension or a body less ([`reduced`], [`plane`]). Rows of the file are not run again.

mod found;
mod judge;
mod measure;
mod named;
mod page;
mod piece;
mod plane;
mod reduced;
mod report;
mod runs;
mod uniform;
mod whole;

#[cfg(test)]
mod tests;

pub use found::{Found, Request};
pub use judge::Verdict;
pub use piece::{Piece, Sort};

use crate::check;
use crate::run::Stop;
use crate::scene::Scene;
use crate::study::accuracy::axis::one_line;
use crate::study::accuracy::row::{COST, Row};
use crate::study::accuracy::source::Source;
use crate::study::accuracy::table::{Header, Table};
use judge::Judge;
use measure::Expected;
use runs::Runs;
use std::path::PathBuf;

/// An ablation that can begin.
pub struct Study {
    request: Request,
    source: Source,
    scene: Scene,
    pieces: Vec<Piece>,
    expected: Vec<Expected>,
    observed: Vec<String>,
    file: PathBuf,
}

/// The word of a row that stands for the scene with all its pieces.
const WHOLE: &str = "whole";
const PIECE: &str = "piece";
const COMBINATION: &str = "combination";

impl Study {
    /// # Errors
    /// One sentence on whatever would stop the scene before its first step, or where nothing tells what it needs.
    pub fn plan(request: &Request) -> Result<Self, String> {
        let source = Source::new(request.scene.clone(), request.variant.clone())?;
        let scene = source.open(&request.set)?;
        scene.one_formulation("study ablate")?;
        check::references(&scene.file, source.folder())?;
        let (expected, observed) = (measure::expected(&scene), measure::observed(&scene));
        if expected.is_empty() && (request.error.is_none() || observed.is_empty()) {
            return Err(format!(
                "{} expects nothing, so that nothing tells what it needs: name a change of its observables with --error 1%",
                scene.label()
            ));
        }
        let typed = source.read_with(&request.set)?.file;
        let mut pieces = named::pieces(&scene, &typed);
        pieces.extend(reduced::pieces(&scene, &typed));
        let file = request.out.clone().unwrap_or_else(|| format!("out/study/{}-ablate.csv", scene.label()).into());
        Ok(Self { request: request.clone(), source, scene, pieces, expected, observed, file })
    }

    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// What is about to run.
    pub fn announcement(&self) -> String {
        let (label, count, file) = (self.scene.label(), self.pieces.len(), self.file.display());
        let runs = (count + 1) * self.request.repeats as usize;
        format!("{label}: {runs} runs of the scene and without each of {count} pieces, then of combinations, into {file}")
    }

    fn header(&self) -> Result<Header, String> {
        let set = self.request.set.iter().map(|set| format!(" {}", one_line(set))).collect::<String>();
        let mut columns: Vec<String> = ["run", "without", "overrides", "repeat"].map(String::from).to_vec();
        columns.extend(COST.map(String::from));
        for expected in &self.expected {
            let word = if expected.is_error() { "error" } else { "seen" };
            columns.extend([format!("{word}_{}", expected.name), format!("fraction_{}", expected.name)]);
        }
        for name in &self.observed {
            columns.extend(["value", "change", "relative_change"].map(|word| format!("{word}_{name}")));
        }
        columns.push("status".into());
        Ok(Header { stamp: self.source.stamp("ablate", &self.scene)? + &set, columns, errors: self.numbers() })
    }

    fn numbers(&self) -> usize {
        judge::EXPECTED * self.expected.len() + judge::OBSERVED * self.observed.len()
    }

    /// Runs what the file lacks; tells of each run in a line.
    ///
    /// # Errors
    /// The file is of another study or cannot be written, the scene itself fails, or the user stops the study.
    pub fn run(&self, mut tell: impl FnMut(&str)) -> Result<Found, Stop> {
        let header = self.header().map_err(Stop::Refused)?;
        let table = Table::open(&self.file, &header, &|_| true, self.request.force).map_err(Stop::Refused)?;
        let mut runs = Runs { study: self, table, series: None };
        for repeat in 1..=self.request.repeats {
            runs.whole(repeat, &mut tell)?;
            for piece in &self.pieces {
                runs.of(PIECE, piece, repeat, &mut tell)?;
            }
        }
        let whole = runs.cheapest(WHOLE, None).ok_or_else(|| Stop::Failed("the scene itself has no row".into()))?;
        let judge = Judge { expected: self.expected.clone(), observed: self.observed.clone(), error: self.request.error, whole };
        let cheapest = |piece: &Piece| Some((piece.clone(), runs.cheapest(PIECE, Some(piece))?));
        let rows: Vec<(Piece, Row)> = self.pieces.iter().filter_map(cheapest).collect();
        let smallest = self.smallest(&judge, &rows, &mut runs, &mut tell)?;
        Ok(Found { judge, rows, smallest })
    }

    /// All pieces that may go at once if that is within tolerance, else one after the other, the most costly first, as
    /// long as the rest stays within tolerance. Each combination is run.
    fn smallest(
        &self,
        judge: &Judge,
        rows: &[(Piece, Row)],
        runs: &mut Runs,
        tell: &mut impl FnMut(&str),
    ) -> Result<Option<(Piece, Row)>, Stop> {
        let mut spare: Vec<&(Piece, Row)> =
            rows.iter().filter(|(piece, row)| judge.verdict(row).may_go() && judge.is_cheaper(piece.sort, row)).collect();
        let saved = |row: &Row| judge.saved(row).map_or(0.0, |saved| saved[0]);
        spare.sort_by(|a, b| saved(&b.1).total_cmp(&saved(&a.1)));
        let mut all: Vec<&Piece> = Vec::new();
        for (piece, _) in &spare {
            if Piece::joined(&[&all[..], &[piece]].concat()).is_some() {
                all.push(piece);
            }
        }
        let fits = |row: &Row| judge.verdict(row).may_go() && judge.is_cheaper(Sort::Named, row);
        if all.len() > 1
            && let Some(joined) = Piece::joined(&all)
        {
            let row = runs.of(COMBINATION, &joined, 1, tell)?;
            if fits(&row) {
                return Ok(Some((joined, row)));
            }
        }
        let mut kept: Option<(Vec<&Piece>, Piece, Row)> = None;
        for (piece, row) in spare {
            let Some((pieces, ..)) = &kept else {
                kept = Some((vec![piece], piece.clone(), row.clone()));
                continue;
            };
            let more = [&pieces[..], &[piece]].concat();
            let Some(joined) = Piece::joined(&more) else { continue };
            let row = runs.of(COMBINATION, &joined, 1, tell)?;
            if fits(&row) {
                kept = Some((more, joined, row));
            }
        }
        Ok(kept.map(|(_, piece, row)| (piece, row)))
    }

    /// The table, what the scene does not need, and the smallest model; writes pictures and a page beside the CSV.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn report(&self, found: &Found) -> Result<String, String> {
        page::write(&self.file, &self.scene, &self.request, found)?;
        Ok(report::text(&self.scene, &self.request, found))
    }
}
