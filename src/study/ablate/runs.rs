//! Runs of an ablation: each a row of the file, made once.

use super::measure::{self, Run, Whole};
use super::piece::Piece;
use super::{Study, WHOLE, whole};
use crate::observable::Table as Series;
use crate::run::{self, Finished, INTERRUPTED, Options, Stop};
use crate::scene::Scene;
use crate::study::accuracy::axis::one_line;
use crate::study::accuracy::row::{self, Cost, OK, Row};
use crate::study::accuracy::table::Table;
use std::sync::atomic::Ordering;

/// The file of a study and the series of the whole scene.
pub struct Runs<'a> {
    pub study: &'a Study,
    pub table: Table,
    pub series: Option<Series>,
}

impl Runs<'_> {
    fn key(word: &str, piece: Option<&Piece>, repeat: u32) -> Vec<String> {
        let (name, overrides) = piece.map_or_else(Default::default, |piece| (piece.name.clone(), piece.overrides.join("; ")));
        vec![word.into(), name, overrides, repeat.to_string()]
    }

    /// The row of a run that was made before.
    fn held(&self, key: &[String]) -> Option<Row> {
        self.table.rows.iter().find(|row| row.key == key).cloned()
    }

    /// The cheapest repeat that came to its end, else the first.
    pub fn cheapest(&self, word: &str, piece: Option<&Piece>) -> Option<Row> {
        let key = Self::key(word, piece, 1);
        let own = || self.table.rows.iter().filter(|row| row.subject() == &key[..3]);
        let ended = own().filter(|row| row.cost.is_some());
        let seconds = |row: &&Row| row.cost_of(Cost::CpuSeconds).unwrap_or(f64::INFINITY);
        ended.min_by(|a, b| seconds(a).total_cmp(&seconds(b))).or_else(|| own().next()).cloned()
    }

    /// The scene with all its pieces; its series are kept beside the rows, for those that a later start adds.
    pub fn whole(&mut self, repeat: u32, tell: &mut impl FnMut(&str)) -> Result<(), Stop> {
        let beside = self.study.file.with_extension("whole.csv");
        let key = Self::key(WHOLE, None, repeat);
        let held = self.held(&key).is_some();
        if self.series.is_none() && held {
            self.series = whole::read(&beside).ok();
        }
        if held && self.series.is_some() {
            return Ok(());
        }
        let study = self.study;
        let finished = study.go(&study.scene)?;
        if self.series.is_none() {
            whole::write(&beside, &finished).map_err(Stop::Failed)?;
            self.series = Some(whole::table(&finished));
        }
        if !held {
            let row = self.row(key, &study.scene, None, &finished);
            tell(&line(self.table.append(row).map_err(Stop::Failed)?));
        }
        Ok(())
    }

    /// The scene without a piece.
    pub fn of(&mut self, word: &str, piece: &Piece, repeat: u32, tell: &mut impl FnMut(&str)) -> Result<Row, Stop> {
        let key = Self::key(word, Some(piece), repeat);
        if let Some(row) = self.held(&key) {
            return Ok(row);
        }
        let study = self.study;
        let overrides: Vec<String> = study.request.set.iter().chain(&piece.overrides).cloned().collect();
        let opened = match &piece.refused {
            Some(reason) => Err(reason.clone()),
            None => study.source.open(&overrides),
        };
        let row = match opened {
            Err(reason) => self.none(key, format!("refused: {}", one_line(&reason))),
            Ok(scene) => match study.go(&scene) {
                Ok(finished) => self.row(key, &scene, Some(piece), &finished),
                Err(Stop::Interrupted(_)) => return Err(self.interrupted()),
                Err(Stop::Failed(reason) | Stop::Refused(reason)) => self.none(key, format!("failed: {}", one_line(&reason))),
            },
        };
        let row = self.table.append(row).map_err(Stop::Failed)?;
        tell(&line(row));
        Ok(row.clone())
    }

    fn none(&self, key: Vec<String>, status: String) -> Row {
        Row { key, cost: None, errors: vec![None; self.study.numbers()], status }
    }

    fn row(&self, key: Vec<String>, scene: &Scene, piece: Option<&Piece>, finished: &Finished) -> Row {
        let study = self.study;
        let run = Run { scene, finished, folder: study.source.folder(), piece };
        let (mut errors, missing) = measure::of_expectations(&study.expected, &run);
        let own = whole::table(finished);
        let whole = Whole { scene: &study.scene, table: self.series.as_ref().unwrap_or(&own) };
        errors.extend(measure::of_observables(&study.observed, &whole, &run));
        let status = missing.map_or_else(|| OK.to_string(), |reason| format!("not judged: {}", one_line(&reason)));
        Row { key, cost: Some(row::cost(finished)), errors, status }
    }

    fn interrupted(&self) -> Stop {
        let (rows, file) = (self.table.rows.len(), self.study.file.display());
        Stop::Interrupted(format!("interrupted with {rows} runs in {file}; the same command goes on from there"))
    }
}

/// A line for the terminal about a run that has ended.
fn line(row: &Row) -> String {
    let seconds = row.cost_of(Cost::CpuSeconds).map_or_else(String::new, |seconds| format!(", {seconds:.2} s"));
    format!("{} {}: {}{seconds}", row.key[0], row.key[1], row.status)
}

impl Study {
    fn go(&self, scene: &Scene) -> Result<Finished, Stop> {
        // A run looks for an interrupt itself; between two runs it must be looked for here.
        if INTERRUPTED.load(Ordering::Relaxed) {
            return Err(Stop::Interrupted(format!("interrupted; the same command goes on with {}", self.file.display())));
        }
        let options = Options {
            choice: self.request.choice.clone(),
            dry: true,
            quiet: true,
            energy: Options::UNWATCHED,
            ..Options::default()
        };
        run::run(scene, &options)
    }
}
