//! What pictures are drawn along, and how.

/// What is measured along one side of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// With its unit.
    pub label: String,
    /// In powers of ten; what is not positive is shown at the lower end.
    pub log: bool,
    /// Found from what is shown unless given.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: false, range: None }
    }
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: true, range: None }
    }
    /// Shows this range, and nothing beyond it.
    #[must_use]
    pub fn within(self, range: [f64; 2]) -> Self {
        Self { range: Some(range), ..self }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    Points,
    Line,
    LinePoints,
    Dashed,
}
