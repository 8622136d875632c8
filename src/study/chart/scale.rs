//! Where a number lies along an axis, and the numbers written there.

use super::Axis;
use crate::output::{axis, csv::shortest};

/// Room on either side of what is shown, in parts of its extent.
const MARGIN: f64 = 0.05;
/// Decades from which only whole powers of ten are written.
const FEW_DECADES: f64 = 1.6;

/// An axis with its range and its ticks.
#[derive(Debug, Clone)]
pub struct Scale {
    pub label: String,
    /// Value and its label; an empty one is a line without a number.
    pub ticks: Vec<(f64, String)>,
    log: bool,
    /// Of the decimal logarithms where the axis has them.
    range: [f64; 2],
}

impl Scale {
    pub fn new(axis: &Axis, shown: impl Iterator<Item = f64>) -> Self {
        let measure = |value: f64| if axis.log { value.log10() } else { value };
        let range = axis.range.map_or_else(|| extent(shown.map(measure)), |range| range.map(measure));
        let (ticks, label) = if axis.log { (decades(range), axis.label.clone()) } else { even(range, &axis.label) };
        Self { label, ticks, log: axis.log, range }
    }

    /// Where `value` lies from 0 to 1; `None` beyond the range and for what is not finite.
    pub fn part(&self, value: f64) -> Option<f64> {
        if !value.is_finite() {
            return None;
        }
        let measure = match self.log {
            true if value <= 0.0 => self.range[0],
            true => value.log10(),
            false => value,
        };
        let part = (measure - self.range[0]) / (self.range[1] - self.range[0]);
        // What lies on the end of a range that was given is on it in spite of rounding.
        (-1e-9..=1.0 + 1e-9).contains(&part).then(|| part.clamp(0.0, 1.0))
    }
}

/// Range of the finite values with some room.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let finite = values.filter(|value| value.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    if low > high {
        return [0.0, 1.0];
    }
    let room = if high > low { MARGIN * (high - low) } else { 0.5 * low.abs().max(1.0) };
    [low - room, high + room]
}

fn even(range: [f64; 2], label: &str) -> (Vec<(f64, String)>, String) {
    let axis = axis::Axis::new(range, 6);
    let ticks = axis.ticks.iter().map(|&tick| (tick, axis.label(tick))).collect();
    let label = if axis.power == 0 { label.to_string() } else { format!("{label} (times {})", power_of_ten(axis.power)) };
    (ticks, label)
}

fn decades([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    let every = ((high - low) / 7.0).ceil().max(1.0) as i32;
    let mut ticks = Vec::new();
    for decade in (low.floor() as i32)..=(high.ceil() as i32) {
        for digit in 1..10 {
            let value = f64::from(digit) * 10f64.powi(decade);
            if !(low - 1e-9..=high + 1e-9).contains(&value.log10()) || (digit > 1 && every > 1) {
                continue;
            }
            let written = match digit {
                1 => decade.rem_euclid(every) == 0,
                2 | 5 => high - low < FEW_DECADES,
                _ => high - low < 0.5 * FEW_DECADES,
            };
            ticks.push((value, if written { number(value, digit, decade) } else { String::new() }));
        }
    }
    ticks
}

/// In plain digits where these are few.
fn number(value: f64, digit: i32, decade: i32) -> String {
    match (decade, digit) {
        (-3..=3, _) => shortest((value * 1e6).round() / 1e6),
        (_, 1) => power_of_ten(decade),
        _ => format!("{digit}·{}", power_of_ten(decade)),
    }
}

fn power_of_ten(power: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |letter: char| letter.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    format!("10{}", power.to_string().chars().map(raised).collect::<String>())
}
