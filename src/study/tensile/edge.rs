//! The edge of a linear function: estimates of f(x) = x and of its slope near the ends of a row of particles; figure 3.3-5.

use super::draw::{chart, curve, dashed};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::windows::digits;
use crate::smoothing::Smoothing;
use crate::study::chart::{Axis, Table};

/// Estimates at one particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Place, with the left end of the body at 0; in spacings.
    pub x: f64,
    /// Sum V W, which should be 1.
    pub unity: f64,
    /// Sum V f W, which should be x.
    pub value: f64,
    /// The same over sum V W (Shepard).
    pub shepard: f64,
    /// Sum V f_b dW/dx, which should be 1: the kernel estimate of the gradient.
    pub gradient: f64,
    /// Sum V (f_b - f_a) dW/dx: as strain rates are summed.
    pub difference: f64,
    /// The same over sum V (x_b - x_a) dW/dx (Bonet & Lok).
    pub corrected: f64,
}

/// Estimates at `count` particles in the middle of cells of width 1.
pub fn estimates(smoothing: Smoothing, h: f64, count: usize) -> Vec<Estimate> {
    let place = |k: usize| k as f64 + 0.5;
    let at = |a: usize| {
        let x = place(a);
        let mut e = Estimate { x, unity: 0.0, value: 0.0, shepard: 0.0, gradient: 0.0, difference: 0.0, corrected: 0.0 };
        let mut moment = 0.0;
        for b in (0..count).map(place) {
            let r = (x - b).abs();
            let weight = smoothing.value(r, h, 1);
            let slope = if r == 0.0 { 0.0 } else { smoothing.derivative(r, h, 1) * (x - b) / r };
            e.unity += weight;
            e.value += b * weight;
            e.gradient += b * slope;
            e.difference += (b - x) * slope;
            moment += (b - x) * slope;
        }
        e.shepard = e.value / e.unity;
        e.corrected = e.difference / moment;
        e
    };
    (0..count).map(at).collect()
}

const COUNT: usize = 20;

pub fn linear() -> Findings {
    let mut rows = Vec::new();
    for &smoothing in Smoothing::ALL {
        for h in [1.0, 1.2, 1.3, 1.5, 1.8] {
            for e in estimates(smoothing, h, COUNT) {
                let cells = [e.x, e.unity, e.value, e.shepard, e.gradient, e.difference, e.corrected].map(|x| format!("{x:.5}"));
                rows.push([vec![smoothing.word().to_string(), h.to_string()], cells.to_vec()].concat());
            }
        }
    }
    let found = estimates(Smoothing::CubicSpline, 1.3, COUNT);
    let line = |of: fn(&Estimate) -> f64| found.iter().map(|e| [e.x, of(e)]).collect::<Vec<_>>();
    let values = chart(
        "Estimates of f(x) = x",
        "Cubic spline, h 1.3 dx, a row of 20 particles.",
        Axis::linear("x, dx"),
        Axis::linear("estimate of f, dx"),
        vec![
            dashed("exact", 2, found.iter().map(|e| [e.x, e.x]).collect()),
            curve("sum V f W", 0, line(|e| e.value)),
            curve("over sum V W (Shepard)", 1, line(|e| e.shepard)),
        ],
    );
    let gradients = chart(
        "Estimates of its slope",
        &format!("The plain sum falls to {} at the right end, where f is not small.", digits(found[COUNT - 1].gradient)),
        Axis::linear("x, dx"),
        Axis::linear("estimate of df/dx").within([-0.5, 1.5]),
        vec![
            curve("sum V f grad W", 0, line(|e| e.gradient)),
            curve("sum V (f_b - f_a) grad W", 1, line(|e| e.difference)),
            curve("corrected", 2, line(|e| e.corrected)),
        ],
    );
    let columns = [
        "kernel",
        "h/dx",
        "x, dx",
        "sum V W",
        "sum V f W",
        "over sum V W",
        "sum V f grad W",
        "sum V (f_b - f_a) grad W",
        "corrected",
    ];
    let exhibit = Exhibit {
        stem: "edge".into(),
        heading: "The edge of a linear function".into(),
        text: vec![
            "Estimates of f(x) = x and of its slope on a row of particles with two ends, for all kernels. At the end of \
             the body half the neighbours are missing: the slope from differences is exactly half of that inside. Shepard's \
             value does not reproduce a linear function at the end; the corrected slope is exact to rounding."
                .into(),
        ],
        pictures: vec![values, gradients],
        table: Some(Table { columns: table_columns(&columns), rows }),
    };
    Findings { exhibits: vec![exhibit], statements: statements(&found) }
}

fn statements(found: &[Estimate]) -> Vec<Statement> {
    let (middle, end) = (found[COUNT / 2], found[0]);
    let place = "figure 3.3-5, p. 61";
    let last = found[COUNT - 1];
    let wrong = found[..COUNT / 2].iter().filter(|e| (e.difference / middle.difference - 1.0).abs() > 1e-3).count();
    let exact = found.iter().map(|e| (e.corrected - 1.0).abs()).fold(0.0, f64::max);
    vec![
        Statement::new(
            place,
            "in the middle the estimate is good",
            format!(
                "value off by {:.1e}, slope by {:+.1} %",
                (middle.value / middle.x - 1.0).abs(),
                100.0 * (middle.gradient - 1.0)
            ),
            (middle.gradient - 1.0).abs() < 0.05 && (middle.value / middle.x - 1.0).abs() < 0.05,
        ),
        Statement::new(
            place,
            "near the edge the deficiency of the kernel is clear",
            format!(
                "slope at the outermost particles {} and {}, from differences {}; {wrong} particles off at each end",
                digits(end.gradient),
                digits(last.gradient),
                digits(end.difference)
            ),
            end.difference < 0.6 * middle.difference,
        ),
        Statement::new(
            "3.3.3, p. 61",
            "stress and velocity are approximately zero at a border, and density drops to zero there",
            format!(
                "the estimate of a constant is {} of it at the outermost particle and {} at the one before it",
                digits(end.unity),
                digits(found[1].unity)
            ),
            end.unity < 0.1,
        ),
        Statement::new(
            "3.3.3, p. 62",
            "normalised kernels make up for the missing particles",
            format!(
                "the corrected slope is off by {exact:.0e}; Shepard's value is off by {} dx at the outermost particle, from {} dx",
                digits((end.shepard - end.x).abs()),
                digits((end.value - end.x).abs())
            ),
            exact < 1e-12,
        ),
    ]
}
