//! How a scene that cannot be is refused.

use super::read::Source;

/// Makes the sentences of refusals.
pub(super) struct Refuse<'a> {
    pub source: &'a Source,
    /// For each body, copies among them, the place where it was typed.
    pub typed_at: &'a [usize],
    /// Name of the formulation that a path to `formulation` means; None for the plain one.
    pub formulation: Option<&'a str>,
}

impl Refuse<'_> {
    pub(super) fn at(&self, path: &[&str], message: impl Into<String>) -> String {
        let body = path.get(1).filter(|_| path[0] == "body").and_then(|at| at.parse().ok());
        let typed = body.and_then(|k: usize| self.typed_at.get(k)).map(usize::to_string);
        let mut path = path.to_vec();
        if let Some(typed) = &typed {
            path[1] = typed;
        }
        if let (Some(&"formulation"), Some(name)) = (path.first(), self.formulation) {
            path.insert(1, name);
        }
        format!("{}: {}", self.source.place(&path), message.into())
    }
    pub(super) fn unless(&self, holds: bool, path: &[&str], message: impl FnOnce() -> String) -> Result<(), String> {
        if holds { Ok(()) } else { Err(self.at(path, message())) }
    }
}

/// Most rows of a series. A scene with more is taken for an error in the unit of time, and refused before it fills the memory.
pub(super) const MOST_OUTPUTS: f64 = 1e6;
