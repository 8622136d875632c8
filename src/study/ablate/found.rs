//! What an ablation is asked, and what it finds.

use super::judge::{Judge, Verdict};
use super::piece::Piece;
use crate::backend::Choice;
use crate::study::accuracy::row::Row;
use std::path::PathBuf;

/// What the command line asks of an ablation.
#[derive(Debug, Clone, Default)]
pub struct Request {
    pub scene: PathBuf,
    pub variant: Option<String>,
    /// Overrides of the scene that is taken apart.
    pub set: Vec<String>,
    pub choice: Choice,
    /// A fraction in place of the scene's tolerances.
    pub error: Option<f64>,
    /// Runs of the scene and of each piece; the cheapest counts.
    pub repeats: u32,
    /// `out/study/SCENE[-VARIANT]-ablate.csv` unless given.
    pub out: Option<PathBuf>,
    pub force: bool,
}

/// What an ablation found.
pub struct Found {
    pub(super) judge: Judge,
    /// The cheapest run without each piece.
    pub(super) rows: Vec<(Piece, Row)>,
    /// The smallest model within tolerance and its run; `None` where every piece is needed.
    pub smallest: Option<(Piece, Row)>,
}

impl Found {
    /// Pieces and what they turned out to be.
    pub fn verdicts(&self) -> impl Iterator<Item = (&Piece, Verdict)> {
        self.rows.iter().map(|(piece, row)| (piece, self.judge.verdict(row)))
    }

    /// A verdict in words, with a remark where it saves nothing.
    pub(super) fn says(&self, piece: &Piece, row: &Row) -> String {
        let verdict = self.judge.verdict(row);
        let dear = verdict.may_go() && !self.judge.is_cheaper(piece.sort, row);
        verdict.text(piece.sort) + if dear { ", but takes longer" } else { "" }
    }
}
