//! The epsilon that let no wave grow, and the one that lets waves grow least.

use super::case::{Case, STABLE};
use rayon::prelude::*;

/// The range of epsilon that scans go through where dp is dx.
pub const RANGE: [f64; 2] = [1e-4, 1e3];

/// Numbers from `low` to `high`, each the same multiple of the one before.
pub fn logarithmic([low, high]: [f64; 2], points: usize) -> Vec<f64> {
    let step = (high / low).ln() / (points - 1) as f64;
    (0..points).map(|k| low * (step * k as f64).exp()).collect()
}

/// Intervals of epsilon within `range` in which no wave grows. Beside a wider one, one that is narrower than a step of the
/// scan may be missed.
pub fn windows(case: Case, range: [f64; 2], points: usize) -> Vec<[f64; 2]> {
    let scan = logarithmic(range, points);
    let stable: Vec<bool> = scan.par_iter().map(|&epsilon| case.epsilon(epsilon).is_stable()).collect();
    let edge = |good: f64, bad: f64| {
        let halve = |(good, bad): (f64, f64), _| {
            let middle = (good * bad).sqrt();
            if case.epsilon(middle).is_stable() { (middle, bad) } else { (good, middle) }
        };
        (0..22).fold((good, bad), halve).0
    };
    if !stable.contains(&true) {
        // Perhaps a window between two points of the scan.
        let step = scan[1] / scan[0];
        let (best, least) = calmest(case, range, points);
        return if least < STABLE { vec![[edge(best, best / step), edge(best, best * step)]] } else { Vec::new() };
    }
    let mut found = Vec::new();
    let mut k = 0;
    while k < points {
        if !stable[k] {
            k += 1;
            continue;
        }
        let first = k;
        while k + 1 < points && stable[k + 1] {
            k += 1;
        }
        let low = if first == 0 { scan[0] } else { edge(scan[first], scan[first - 1]) };
        let high = if k + 1 == points { scan[k] } else { edge(scan[k], scan[k + 1]) };
        found.push([low, high]);
        k += 1;
    }
    found
}

/// The epsilon within `range` that grows least, and its rate in c/dx: the best of a scan, made finer between its neighbours.
pub fn calmest(case: Case, range: [f64; 2], points: usize) -> (f64, f64) {
    let best = |scan: &[f64]| {
        let grown: Vec<(f64, f64)> = scan.par_iter().map(|&epsilon| (epsilon, case.epsilon(epsilon).growth())).collect();
        grown.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((range[0], f64::INFINITY))
    };
    let step = (range[1] / range[0]).powf(1.0 / (points - 1) as f64);
    let (coarse, _) = best(&logarithmic(range, points));
    best(&logarithmic([(coarse / step).max(range[0]), (coarse * step).min(range[1])], 33))
}

/// Windows in words: `0.052 .. 1.17`, or `none`.
pub fn shown(windows: &[[f64; 2]]) -> String {
    let one = |&[low, high]: &[f64; 2]| format!("{} .. {}", digits(low), digits(high));
    if windows.is_empty() { "none".into() } else { windows.iter().map(one).collect::<Vec<_>>().join(", ") }
}

/// Three digits.
pub fn digits(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 {
        "0".into()
    } else if !(1e-3..1e4).contains(&magnitude) {
        format!("{value:.2e}")
    } else {
        format!("{value:.*}", (2 - magnitude.log10().floor() as i32).max(0) as usize)
    }
}
