//! The repulsive force by von Neumann's analysis: what dp means, and the epsilon that let no wave grow.

use super::case::{Case, Form, Law, STABLE, Spacing};
use super::draw::{chart, curve, dashed, dots};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::published as strand;
use super::windows::{RANGE, calmest, digits, logarithmic, shown, windows};
use super::{line, plane};
use crate::study::chart::{Axis, Table};
use rayon::prelude::*;

/// Number of neighbours and the two meanings of dp; section 5.1.3.1.
pub fn spacing() -> Findings {
    let mut findings = Findings::default();
    let mut rows = Vec::new();
    let counts = strand::NEIGHBOURS.map(|(dimension, ratio, published)| {
        let case = Case::new(dimension, ratio).spacing(Spacing::Mean);
        let (count, mean) = (case.distances().len(), case.dp());
        rows.push(vec![
            dimension.to_string(),
            ratio.to_string(),
            count.to_string(),
            published.to_string(),
            format!("{mean:.4}"),
            format!("{:.4}", ratio / mean),
            digits(case.strength()),
        ]);
        (count, published)
    });
    let list = |pick: fn(&(usize, usize)) -> usize| counts.iter().map(|c| pick(c).to_string()).collect::<Vec<_>>().join(", ");
    findings.statements.push(Statement::new(
        "5.1.3.6, p. 118-119",
        format!("h 0.7, 1.3, 1.8 dx on a line and 1.3, 1.52, 1.8 dx in the plane: {} neighbours", list(|c| c.1)),
        list(|c| c.0),
        counts.iter().all(|(found, published)| found == published),
    ));
    for ((neighbours, published), ratio) in strand::LINE_MEANS.into_iter().zip([1.3, 1.8]) {
        let mean = Case::new(1, ratio).spacing(Spacing::Mean).dp();
        let found = ratio / mean;
        let note = format!("{found:.3} at h {ratio} dx; {published} would be h {:.2} dx", published * mean);
        findings.statements.push(Statement::new(
            "5.1.3.1, p. 110",
            format!("{neighbours} neighbours on a line: h = {published} mean distances"),
            if (found - published).abs() < 0.005 { format!("{found:.3}") } else { note },
            (found - published).abs() < 0.005,
        ));
    }
    let columns =
        ["dimension", "h/dx", "neighbours", "his", "mean dp/dx", "h/mean dp", "f^4 of the nearest, mean over initial dp"];
    findings.exhibits.push(Exhibit {
        stem: "spacing".into(),
        heading: "Two meanings of dp".into(),
        text: vec![
            "The force is epsilon (|P_a|/rho_a^2 + |P_b|/rho_b^2) f^n along grad W with f = W(r)/W(dp). With dp the \
             initial spacing f is 1 for nearest neighbours; with dp the mean distance of a particle from its neighbours, \
             which lies beyond the nearest, the same epsilon is as many times stronger as the last column says."
                .into(),
        ],
        table: Some(Table { columns: table_columns(&columns), rows }),
        ..Exhibit::default()
    });
    findings
}

/// Points of the scans for windows.
const SCAN: usize = 141;

/// Growth over epsilon in 1D, 2D and 3D, and all windows; section 5.1.3.2, figures 5.1-6 and 5.1-7.
pub fn epsilon() -> Findings {
    let mut findings = Findings::default();
    let shown_range = [1e-6, 1e2];
    let scan = logarithmic(shown_range, 161);
    let grown = |case: Case| -> Vec<[f64; 2]> { scan.par_iter().map(|&e| [e, case.epsilon(e).growth()]).collect() };
    let axes = || (Axis::log("epsilon"), Axis::log("largest growth rate, c/dx").within([1e-3, 1e3]));
    let mut pictures = Vec::new();
    for dimension in 1..=3 {
        let case = Case::new(dimension, 1.3);
        let plain = case.growth();
        let mut series = vec![
            curve("dp initial", 0, grown(case)),
            curve("dp mean", 1, grown(case.spacing(Spacing::Mean))),
            dashed("no repulsive force", 2, vec![[shown_range[0], plain], [shown_range[1], plain]]),
        ];
        match dimension {
            1 => series.push(dots(
                "Strand: stable from here",
                3,
                strand::LINE_LEAST.map(|(_, least)| [least, 1e-3]).to_vec(),
                strand::LINE_LEAST.map(|(spacing, least)| format!("{least} {}", spacing.word())).to_vec(),
            )),
            2 => series.push(dots("Strand: calmest", 3, vec![[strand::PLANE_CALMEST, plain]], vec!["1.3".into()])),
            _ => {}
        }
        let (x, y) = axes();
        let note = "n 4. A curve at the lower end is stable.";
        pictures.push(chart(&format!("Repulsive force in {dimension}D: h 1.3 dx, V 1.01"), note, x, y, series));
    }
    findings.exhibits.push(Exhibit {
        stem: "epsilon".into(),
        heading: "Growth over epsilon".into(),
        text: vec![
            "Largest growth rate of any wave on an infinite lattice of fluid. On a line a window of epsilon stops all \
             growth. It ends because the repulsive force follows the pressure: it takes from the stiffness in bulk what \
             it adds to the stiffness of the lattice, and beyond the window waves collapse in bulk."
                .into(),
        ],
        pictures,
        ..Exhibit::default()
    });
    findings.exhibits.push(all_windows());
    findings.statements.extend(line::line_statements());
    findings.statements.extend(plane::plane_statements());
    findings
}

/// Windows for all that the thesis varies but n and V.
fn all_windows() -> Exhibit {
    let ratios: [&[f64]; 3] = [&[0.7, 1.3, 1.8], &[1.3, 1.52, 1.8], &[1.3, 1.52, 1.8]];
    let mut rows = Vec::new();
    for dimension in 1..=3 {
        for &ratio in ratios[dimension - 1] {
            for (law, form) in [
                (Law::Fluid, Form::Pressure),
                (Law::Fluid, Form::Trace),
                (Law::Elastic, Form::Pressure),
                (Law::Elastic, Form::Principal),
            ] {
                for spacing in [Spacing::Initial, Spacing::Mean] {
                    let case = Case { law, ..Case::new(dimension, ratio).form(form).spacing(spacing) };
                    let (best, least) = calmest(case, case.range(), SCAN);
                    rows.push(vec![
                        dimension.to_string(),
                        ratio.to_string(),
                        format!("{law:?}").to_lowercase(),
                        format!("{form:?}").to_lowercase(),
                        spacing.word(),
                        shown(&windows(case, case.range(), SCAN)),
                        digits(case.growth()),
                        digits(best),
                        digits(if least < STABLE { 0.0 } else { least }),
                    ]);
                }
            }
        }
    }
    let columns =
        ["dimension", "h/dx", "material", "made of", "dp", "stable epsilon", "growth without", "calmest epsilon", "its growth"];
    Exhibit {
        stem: "windows".into(),
        heading: "Stable windows of epsilon".into(),
        text: vec![format!(
            "V 1.01, n 4, epsilon from {} to {} for nearest neighbours (with the mean dp, less by what f^4 is more). `pressure` is Monaghan's epsilon |P|/rho^2; `trace` the epsilon \
             tr(sigma)/rho^2 that the thesis prints for its code, in which the same force has a third of the epsilon; \
             `principal` acts on tensile principal stresses. Rates in c/dx.",
            RANGE[0], RANGE[1]
        )],
        table: Some(Table { columns: table_columns(&columns), rows }),
        ..Exhibit::default()
    }
}
