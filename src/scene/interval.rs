//! The times between outputs, and what they have in common.

use super::file::File;

/// Part of an interval below which two times are one: scenes type decimals of thirds.
pub const ROUNDING: f64 = 1e-6;
/// Part of the time between rows below which a common interval is chance.
const LEAST: f64 = 1e-3;

impl File {
    /// Time between two rows of the series.
    pub fn rows(&self) -> f64 {
        self.output.series.unwrap_or(self.duration / 100.0)
    }

    /// The longest time of which those between outputs are multiples; 0 if there is none worth having. The end of the run is
    /// met once: a step that differs there feeds nothing.
    pub fn interval(&self) -> f64 {
        let rows = self.rows();
        let times = [rows, self.frames()];
        let found = times.into_iter().filter(|&time| time > 0.0).fold(0.0, |a, b| common(a, b, ROUNDING * rows.min(b)));
        if found < LEAST * rows { 0.0 } else { found }
    }
}

/// Euclid's common measure of two times, which are whole multiples of it but for `rounding`.
fn common(a: f64, b: f64, rounding: f64) -> f64 {
    if a.abs() <= rounding { b.abs() } else { common(b - a * (b / a).round(), a, rounding) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_their_common_measure() {
        for (a, b, measure) in [(0.1, 0.25, 0.05), (0.1, 1.0, 0.1), (3.333_333_3, 10.0, 3.333_333_3), (0.3, 0.2, 0.1)] {
            let found = common(a, b, ROUNDING * f64::min(a, b));
            assert!((found - measure).abs() < 1e-5 * measure, "{a} and {b}: {found}");
        }
    }
}
