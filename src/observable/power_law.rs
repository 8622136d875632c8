//! y = factor (x - zero)^exponent through points, by least squares of ln y.

/// Grid of zeros and the golden section that refines the best of them.
const TRIALS: usize = 200;
const REFINEMENTS: usize = 90;

/// A power law with its zero anywhere.
#[derive(Debug, Clone, Copy)]
pub struct PowerLaw {
    pub factor: f64,
    pub zero: f64,
    pub exponent: f64,
}

impl PowerLaw {
    pub fn slope(&self, x: f64) -> f64 {
        self.exponent * self.factor * (x - self.zero).powf(self.exponent - 1.0)
    }
}

/// The law through points (x, y), y above 0, whose zero lies below all x: for each zero the logarithms are fitted by a
/// line, and the zero is that with the least sum of squares, between 1/1000 and 100 of the width of the points below
/// them. None where all x are the same.
pub fn fit(points: &[(f64, f64)]) -> Option<PowerLaw> {
    let low = points.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let width = points.iter().map(|p| p.0).fold(f64::NEG_INFINITY, f64::max) - low;
    if width.is_nan() || width <= 0.0 {
        return None;
    }
    let (first, last) = ((1e-3 * width).ln(), (100.0 * width).ln());
    let step = (last - first) / TRIALS as f64;
    let error = |below: f64| line(points, low - below.exp()).1;
    let trial = |k: usize| first + k as f64 * step;
    let best = (0..=TRIALS).min_by(|&a, &b| error(trial(a)).total_cmp(&error(trial(b))))?;
    let below = least(error, trial(best) - step, trial(best) + step);
    Some(line(points, low - below.exp()).0)
}

/// Where a function with one minimum within a range has it, by the golden section.
fn least(of: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = (5_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..REFINEMENTS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if of(a) < of(b) { high = b } else { low = a }
    }
    (low + high) / 2.0
}

/// The best law with this zero and its sum of squares.
fn line(points: &[(f64, f64)], zero: f64) -> (PowerLaw, f64) {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| ((x - zero).ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let (x, y) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    let (up, down) = logs.iter().fold((0.0, 0.0), |(u, d), p| (u + (p.0 - x) * (p.1 - y), d + (p.0 - x).powi(2)));
    let exponent = up / down;
    let error = logs.iter().map(|p| (p.1 - y - exponent * (p.0 - x)).powi(2)).sum();
    (PowerLaw { factor: (y - exponent * x).exp(), zero, exponent }, error)
}
