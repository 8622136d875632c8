//! The repulsive force over n, h and tension, by von Neumann's analysis; sections 5.1.3.3, 5.1.3.6 and 5.1.3.7.

use super::case::{Case, STABLE, Spacing};
use super::draw::{chart, dots};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::published as strand;
use super::windows::{RANGE, calmest, digits, shown, windows};
use crate::study::chart::{Axis, Map, Picture, Table};
use crate::study::von_neumann::Waves as _;
use rayon::prelude::*;

const SCAN: usize = 141;

/// Windows over n, and over dp as his 5.1.3.3 stretches it.
pub fn exponent() -> Findings {
    let mut findings = Findings::default();
    let mut rows = Vec::new();
    for (dimension, ratio) in [(1, 1.3), (2, 1.3), (2, 1.8), (3, 1.3), (3, 1.8)] {
        for exponent in [1.0, 2.0, 3.0, 4.0, 6.0, 8.0] {
            let case = Case { exponent, ..Case::new(dimension, ratio) };
            let (best, least) = calmest(case, RANGE, SCAN);
            let least = if least < STABLE { 0.0 } else { least };
            rows.push(vec![
                dimension.to_string(),
                ratio.to_string(),
                exponent.to_string(),
                shown(&windows(case, RANGE, SCAN)),
                digits(best),
                digits(least),
                digits(least / case.growth()),
            ]);
        }
    }
    findings.exhibits.push(Exhibit {
        stem: "exponent".into(),
        heading: "Windows over n".into(),
        text: vec!["V 1.01, dp the initial spacing. The thesis keeps n = 4 throughout.".into()],
        table: Some(Table {
            columns: table_columns(&[
                "dimension",
                "h/dx",
                "n",
                "stable epsilon",
                "calmest epsilon",
                "its growth, c/dx",
                "of that without",
            ]),
            rows,
        }),
        ..Exhibit::default()
    });
    let least = |dp: f64| windows(Case::new(1, 1.3).spacing(Spacing::Given(dp)), [1e-12, 1e3], 301);
    let (one, two) = (least(1.0)[0][0], least(2.0)[0][0]);
    findings.statements.push(Statement::new(
        "5.1.3.3, p. 114",
        "on a line, h 1.3 dx: as dp goes from 1 to 2 and 3 dx the epsilon needed falls slightly",
        format!(
            "from {} to {}, {} times; at 3 dx, beyond the kernel's reach of 2.6 dx, W(dp) is 0 and f infinite: no force of that form",
            digits(one),
            digits(two),
            digits(one / two)
        ),
        one / two < 2.0,
    ));
    let case = Case::new(2, 1.3);
    let equations = case.equations().expect("dp is within reach");
    let along = |axis: usize| {
        let rate = |k: [f64; 3]| equations.stiffness(k).col(axis)[axis].max(0.0).sqrt();
        // The zone without its symmetry, so that both axes see all waves.
        super::case::zone(2).iter().flat_map(|&[x, y, z]| [[x, y, z], [y, x, z]]).map(rate).fold(0.0, f64::max)
    };
    findings.statements.push(Statement::new(
        "5.1.3.3, p. 114",
        "in the plane, particles that move along x alone or along y alone grow alike",
        format!("{} and {} c/dx", digits(along(0)), digits(along(1))),
        (along(0) - along(1)).abs() < 1e-9,
    ));
    findings
}

/// Windows over h/dx, and maps of growth over h/dx and tension.
pub fn smoothing_length() -> Findings {
    let ratios: Vec<f64> = (0..=26).map(|k| 0.7 + 0.05 * f64::from(k)).collect();
    let mut pictures = Vec::new();
    let mut rows = Vec::new();
    for dimension in 1..=3 {
        // Below h = dx/sqrt(2) the plane and space have no diagonal neighbours.
        let found: Vec<(f64, Vec<[f64; 2]>)> = ratios
            .iter()
            .filter(|&&ratio| dimension < 3 || (ratio * 20.0).round() as i32 % 2 == 0)
            .map(|&ratio| (ratio, windows(Case::new(dimension, ratio), [1e-3, 1e2], 101)))
            .collect();
        let (mut low, mut high) = (Vec::new(), Vec::new());
        for (ratio, windows) in &found {
            for (n, [from, to]) in windows.iter().enumerate() {
                low.push([*ratio, *from]);
                high.push([*ratio, *to]);
                rows.push(vec![dimension.to_string(), format!("{ratio:.2}"), (n + 1).to_string(), digits(*from), digits(*to)]);
            }
        }
        let mut series = vec![dots("least stable", 0, low, Vec::new()), dots("most", 1, high, Vec::new())];
        let published = match dimension {
            1 => strand::LINE_LEAST_BY_RATIO.iter().filter_map(|(ratio, least)| least.map(|least| [*ratio, least])).collect(),
            2 => vec![[1.8, strand::PLANE_WIDE_STABLE]],
            _ => Vec::new(),
        };
        if !published.is_empty() {
            series.push(dots("Strand: least stable", 3, published, Vec::new()));
        }
        pictures.push(chart(
            &format!("Windows of epsilon over h/dx, {dimension}D"),
            "V 1.01, n 4, dp initial. Where there is no dot no epsilon is stable.",
            Axis::linear("h/dx").within([0.65, 2.05]),
            Axis::log("epsilon").within([1e-3, 1e2]),
            series,
        ));
    }
    let exhibit = Exhibit {
        stem: "smoothing-length".into(),
        heading: "Windows over the smoothing length".into(),
        text: vec!["From the first to the last epsilon, between 0.001 and 100, that lets no wave grow.".into()],
        pictures,
        table: Some(Table { columns: table_columns(&["dimension", "h/dx", "window", "from", "to"]), rows }),
    };
    Findings { exhibits: vec![exhibit, maps()], statements: Vec::new() }
}

/// Growth over (h/dx, V) with and without a repulsive force.
fn maps() -> Exhibit {
    let mut rows = Vec::new();
    let mut pictures = Vec::new();
    for (dimension, points) in [(1, 41), (2, 27), (3, 14)] {
        let spread = |low: f64, high: f64| -> Vec<f64> {
            (0..points).map(|k| low + (high - low) * (f64::from(k) + 0.5) / f64::from(points)).collect()
        };
        for epsilon in [0.0, 0.5] {
            let cells = |volume: f64| -> Vec<f64> {
                let ratios = spread(0.7, 2.0);
                ratios.par_iter().map(|&ratio| Case::new(dimension, ratio).volume(volume).epsilon(epsilon).growth()).collect()
            };
            let volumes = spread(0.98, 1.05);
            let values: Vec<Vec<f64>> = volumes.iter().map(|&volume| cells(volume)).collect();
            for (volume, line) in volumes.iter().zip(&values) {
                rows.extend(spread(0.7, 2.0).iter().zip(line).map(|(ratio, growth)| {
                    vec![
                        dimension.to_string(),
                        epsilon.to_string(),
                        format!("{ratio:.4}"),
                        format!("{volume:.4}"),
                        if *growth < STABLE { "0".into() } else { format!("{growth:.6}") },
                    ]
                }));
            }
            let shown = values.into_iter().map(|line| line.into_iter().map(|g| if g < STABLE { f64::NAN } else { g }).collect());
            pictures.push(Picture::Map(Map {
                title: if epsilon == 0.0 {
                    format!("Growth, {dimension}D, plain")
                } else {
                    format!("Growth, {dimension}D, epsilon {epsilon}")
                },
                note: "Blank: stable. V below 1 is compression, where no repulsive force acts.".into(),
                x: Axis::linear("h/dx").within([0.7, 2.0]),
                y: Axis::linear("relative volume V").within([0.98, 1.05]),
                values: shown.collect(),
                unit: "growth rate, c/dx".into(),
            }));
        }
    }
    Exhibit {
        stem: "growth-maps".into(),
        heading: "Growth over smoothing length and tension".into(),
        text: vec!["Largest growth rate of any wave, without the repulsive force and with epsilon 0.5, n 4, dp initial.".into()],
        pictures,
        table: Some(Table { columns: table_columns(&["dimension", "epsilon", "h/dx", "V", "growth, c/dx"]), rows }),
    }
}
