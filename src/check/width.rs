//! A tolerance that is wider than the error seen hides the next mistake: here it is said which are.

use super::measure::Compared;
use crate::scene::file::{Expect, Statement};

/// Fraction of the scale that f32 may round away in a run: no tolerance below is too wide.
const ROUNDING: f64 = 2e-6;
/// Most that a user would still call right.
const AGREEMENT: f64 = 0.05;
/// Largest ratio of the ends of a range that a source may give.
const RANGE: f64 = 5.0;
/// Part of a known error, and of a number without a truth, by which it may change unnoticed.
const OF_ERROR: f64 = 0.5;
const OF_PINNED: f64 = 0.1;

/// Why a tolerance is too wide for what a run gave.
pub fn too_wide(found: &Compared, expect: &Expect) -> Option<String> {
    typed_too_wide(expect).or_else(|| {
        let (tolerance, error) = (expect.tolerance? * found.unit / found.scale, found.error?.abs() / found.scale);
        if expect.kind != Statement::Truth || tolerance <= ROUNDING {
            return None;
        }
        if tolerance > AGREEMENT * (1.0 + 1e-9) {
            return Some(format!("a tolerance of {:.2} % of {} is no agreement", 100.0 * tolerance, found.of));
        }
        // The sums of decimals that a scene has typed may round.
        (tolerance > 2.0 * error * (1.0 + 1e-9)).then(|| match error {
            0.0 => "the error is 0 and the tolerance is not".into(),
            _ => format!("the tolerance is {:.2} times the error", tolerance / error),
        })
    })
}

/// Why a tolerance is too wide whatever a run gives.
pub fn typed_too_wide(expect: &Expect) -> Option<String> {
    if let Some([low, high]) = expect.between {
        let spans = high / low;
        let ratio = if spans > 0.0 { spans.max(1.0 / spans) } else { f64::INFINITY };
        return (ratio > RANGE * (1.0 + 1e-9)).then(|| format!("the range spans a factor of {ratio:.3}"));
    }
    let (seen, tolerance) = (expect.seen?, expect.tolerance?);
    let (allowed, whole, what) = match (expect.kind, &expect.reference, expect.value) {
        (Statement::Pinned, ..) => (tolerance * expect.unit()?, OF_PINNED * seen.abs(), "a tenth of the number"),
        (_, Some(_), _) => (tolerance, OF_ERROR * seen.abs(), "half of the known error"),
        (_, None, Some(value)) => (tolerance * expect.unit()?, OF_ERROR * (seen - value).abs(), "half of the known error"),
        (_, None, None) => return None,
    };
    (allowed > whole * (1.0 + 1e-9)).then(|| format!("the window is wider than {what}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::file::Scale;

    fn found(error: f64, scale: f64) -> Compared {
        Compared { number: 0.0, error: Some(error), scale, of: "value".into(), unit: 1.0, unit_of_seen: 1.0 }
    }

    fn truth(tolerance: f64) -> Expect {
        Expect { value: Some(1.0), tolerance: Some(tolerance), ..Expect::default() }
    }

    #[test]
    fn a_tolerance_is_at_most_twice_the_error() {
        assert_eq!(too_wide(&found(0.01, 1.0), &truth(0.02)), None);
        assert_eq!(too_wide(&found(-0.01, 1.0), &truth(0.02)), None);
        assert_eq!(too_wide(&found(0.01, 1.0), &truth(0.03)).as_deref(), Some("the tolerance is 3.00 times the error"));
        assert_eq!(too_wide(&found(0.0, 1.0), &truth(0.03)).as_deref(), Some("the error is 0 and the tolerance is not"));
    }

    #[test]
    fn rounding_is_allowed_for_and_disagreement_is_not() {
        assert_eq!(too_wide(&found(0.0, 1.0), &truth(2e-6)), None);
        assert_eq!(too_wide(&found(0.0, 1e3), &truth(2e-3)), None);
        assert!(too_wide(&found(0.05, 1.0), &truth(0.06)).is_some());
    }

    #[test]
    fn what_was_seen_is_held_more_closely_than_its_error() {
        let of = |kind, value, seen, tolerance, relative| {
            let (seen, tolerance) = (Some(seen), Some(tolerance));
            typed_too_wide(&Expect { kind, value, seen, tolerance, relative, ..Expect::default() })
        };
        assert_eq!(of(Statement::Shortfall, Some(1.0), 0.9, 0.05, false), None);
        assert!(of(Statement::Shortfall, Some(1.0), 0.9, 0.06, false).is_some());
        assert!(of(Statement::Failure, Some(100.0), 90.0, 0.06, true).is_some());
        assert_eq!(of(Statement::Pinned, None, 20.0, 2.0, false), None);
        assert_eq!(of(Statement::Pinned, None, 20.0, 0.1, true), None);
        assert!(of(Statement::Pinned, None, 20.0, 0.11, true).is_some());
        let scaled = |tolerance| {
            let (seen, scale) = (Some(0.01), Some(Scale::Number(0.1)));
            let known = Expect { kind: Statement::Failure, value: Some(0.0), seen, scale, relative: true, ..Expect::default() };
            typed_too_wide(&Expect { tolerance: Some(tolerance), ..known })
        };
        assert_eq!(scaled(0.05), None);
        assert!(scaled(0.06).is_some());
    }

    #[test]
    fn a_range_of_a_source_spans_little() {
        let of = |low, high| typed_too_wide(&Expect { between: Some([low, high]), ..Expect::default() });
        assert_eq!(of(0.1, 0.5), None);
        assert_eq!(of(-0.5, -0.1), None);
        assert!(of(-5.0, -0.02).is_some());
        assert!(of(-1.0, 1.0).is_some());
    }
}
