//! Which settings are worth their cost.

use super::measure::Measures;
use super::row::{Cost, Row};

/// An expectation whose error a study measures.
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    pub name: String,
    pub tolerance: Option<f64>,
}

/// A setting on one backend with the cheapest of its finished repeats.
#[derive(Debug, Clone)]
pub struct Best<'a> {
    pub row: &'a Row,
    /// The one that settings are judged by; see [`Measures`].
    pub error: Option<f64>,
    /// No other setting is cheaper and as accurate, or as cheap and more accurate.
    pub on_front: bool,
}

/// Marks the points (cost, error) that no other point is better than in one number and as good in the other. A number
/// that is not finite is never on the front.
pub fn front(points: &[(f64, f64)]) -> Vec<bool> {
    let beats = |p: &(f64, f64), q: &(f64, f64)| p.0 <= q.0 && p.1 <= q.1 && p != q;
    let stays = |q: &(f64, f64)| q.0.is_finite() && q.1.is_finite() && !points.iter().any(|p| beats(p, q));
    points.iter().map(stays).collect()
}

/// The largest error, each over its tolerance so that they compare; the error itself where there is only one.
/// `None` where a number is missing.
pub fn worst(errors: &[Option<f64>], expected: &[Expected]) -> Option<f64> {
    let errors = errors.iter().copied().collect::<Option<Vec<f64>>>()?;
    if let [only] = errors[..] {
        return Some(only).filter(|error| error.is_finite());
    }
    let positive = |expected: &Expected| expected.tolerance.filter(|tolerance| *tolerance > 0.0);
    let scaled = errors.iter().zip(expected).filter_map(|(error, expected)| Some(error / positive(expected)?));
    let larger = |largest: Option<f64>, error: f64| Some(largest.map_or(error, |largest| largest.max(error)));
    errors.iter().all(|error| error.is_finite()).then(|| scaled.fold(None, larger))?
}

/// The cheapest finished row of each setting and backend, by rising cost.
pub fn best<'a>(rows: &'a [Row], measures: &Measures, cost: Cost) -> Vec<Best<'a>> {
    let price = |row: &Row| row.cost_of(cost).unwrap_or(f64::INFINITY);
    let mut cheapest: Vec<&Row> = Vec::new();
    for row in rows.iter().filter(|row| row.cost.is_some()) {
        match cheapest.iter_mut().find(|other| other.subject() == row.subject()) {
            Some(other) if price(row) < price(other) => *other = row,
            Some(_) => {}
            None => cheapest.push(row),
        }
    }
    cheapest.sort_by(|a, b| price(a).total_cmp(&price(b)));
    let errors: Vec<Option<f64>> = cheapest.iter().map(|row| measures.error(row)).collect();
    let point = |(row, error): (&&Row, &Option<f64>)| (price(row), error.unwrap_or(f64::NAN));
    let marks = front(&cheapest.iter().zip(&errors).map(point).collect::<Vec<_>>());
    let each = cheapest.into_iter().zip(errors).zip(marks);
    each.map(|((row, error), on_front)| Best { row, error, on_front }).collect()
}

/// The cheapest setting with no larger an error, of those that [`best`] found.
pub fn cheapest<'a, 'b>(best: &'b [Best<'a>], error: f64) -> Option<&'b Best<'a>> {
    best.iter().find(|best| best.error.is_some_and(|found| found <= error))
}

/// The most accurate setting, of those that [`best`] found.
pub fn most_accurate<'a, 'b>(best: &'b [Best<'a>]) -> Option<&'b Best<'a>> {
    let error = |best: &Best| best.error.unwrap_or(f64::INFINITY);
    best.iter().filter(|best| best.error.is_some()).min_by(|a, b| error(a).total_cmp(&error(b)))
}
