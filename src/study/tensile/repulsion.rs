//! The repulsive force by von Neumann's analysis: what dp means, and the epsilon that let no wave grow.

use super::case::{Case, Form, Law, RANGE, STABLE, Spacing, calmest, digits, logarithmic, shown, windows};
use super::draw::{chart, curve, dashed, dots};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::published as strand;
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
    for (dimension, name) in [(1, "line"), (2, "plane"), (3, "space")] {
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
        let note = "A curve at the lower end is stable.";
        pictures.push(chart(&format!("Repulsive force on a {name}: h 1.3 dx, V 1.01, n 4"), note, x, y, series));
    }
    findings.exhibits.push(Exhibit {
        stem: "epsilon".into(),
        heading: "Growth over epsilon".into(),
        text: vec![
            "Largest growth rate of any wave on an infinite lattice of fluid. On a line a window of epsilon stops all \
             growth. It ends because the repulsive force follows the pressure: it takes from the stiffness in bulk what \
             it adds to the stiffness of the lattice, and waves collapse in bulk from about epsilon 1 on."
                .into(),
        ],
        pictures,
        ..Exhibit::default()
    });
    findings.exhibits.push(all_windows());
    findings.statements.extend(line_statements());
    findings.statements.extend(plane_statements());
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

fn line_statements() -> Vec<Statement> {
    let mut statements = Vec::new();
    for (spacing, least) in strand::LINE_LEAST {
        let case = Case::new(1, 1.3).spacing(spacing);
        let (found, trace) = (windows(case, case.range(), SCAN), windows(case.form(Form::Trace), case.range(), SCAN));
        statements.push(Statement::new(
            "5.1.3.2 and figure 5.1-7, p. 112-113",
            format!("on a line, dp {}, stable from epsilon {least} to about {}", spacing.word(), strand::LINE_MOST),
            format!("stable for {} as epsilon |P|, for {} as epsilon tr(sigma)", shown(&found), shown(&trace)),
            [found, trace].iter().any(|w| w.len() == 1 && near(w[0][0], least, 0.1) && near(w[0][1], strand::LINE_MOST, 0.3)),
        ));
        let inside = case.epsilon(least).is_stable();
        statements.push(Statement::new(
            "5.1.3.2, p. 112",
            format!("epsilon {least} with dp {} is stable on a line", spacing.word()),
            if inside { "stable".into() } else { format!("grows at {} c/dx", digits(case.epsilon(least).growth())) },
            inside,
        ));
    }
    for (ratio, least) in strand::LINE_LEAST_BY_RATIO.into_iter().filter(|(ratio, _)| *ratio != 1.3) {
        let found = windows(Case::new(1, ratio), RANGE, SCAN);
        let published = least.map_or("no epsilon is stable".into(), |least: f64| format!("stable from epsilon {least:.3}"));
        let agrees = match least {
            None => found.is_empty(),
            Some(least) => found.first().is_some_and(|w| near(w[0], least, 0.1)),
        };
        let text = format!("stable for {}", shown(&found));
        statements.push(Statement::new(
            "5.1.3.6 and figure 5.1-10, p. 118-119",
            format!("on a line, h {ratio} dx: {published}"),
            text,
            agrees,
        ));
    }
    let falls = |ratio| windows(Case::new(1, ratio), RANGE, SCAN)[0][0];
    let (narrow, wide) = (falls(1.3), falls(1.8));
    statements.push(Statement::new(
        "5.1.3.6, p. 118",
        "on a line the least stable epsilon falls with h, to 0.54 of it from h 1.3 to 1.8 dx",
        format!("it falls, to {} of it", digits(wide / narrow)),
        wide < narrow,
    ));
    statements
}

fn plane_statements() -> Vec<Statement> {
    let mut statements = Vec::new();
    let place = "5.1.3.2 and figure 5.1-6, p. 111-112";
    for spacing in [Spacing::Mean, Spacing::Initial] {
        let case = Case::new(2, 1.3).spacing(spacing);
        let found = windows(case, case.range(), SCAN);
        let (best, least) = calmest(case, case.range(), SCAN);
        let text =
            format!("stable for {}; least growth {} c/dx, of {} without", shown(&found), digits(least), digits(case.growth()));
        statements.push(Statement::new(
            place,
            format!("in the plane, h 1.3 dx, dp {}: no epsilon is stable", spacing.word()),
            text,
            found.is_empty(),
        ));
        if spacing == Spacing::Mean {
            let at = case.epsilon(strand::PLANE_CALMEST).growth();
            statements.push(Statement::new(
                place,
                format!("the calmest epsilon there is {}", strand::PLANE_CALMEST),
                format!(
                    "{}; {} grows at {} c/dx, and with dp initial, where {} is calmest, at {}",
                    digits(best),
                    strand::PLANE_CALMEST,
                    digits(at),
                    digits(calmest(Case::new(2, 1.3), RANGE, SCAN).0),
                    digits(Case::new(2, 1.3).epsilon(strand::PLANE_CALMEST).growth())
                ),
                near(best, strand::PLANE_CALMEST, 0.3),
            ));
        }
    }
    let place = "5.1.3.6 and figure 5.1-11, p. 119-120";
    let middle = windows(Case::new(2, 1.52), RANGE, SCAN);
    statements.push(Statement::new(place, "in the plane, h 1.52 dx: no epsilon is stable", shown(&middle), middle.is_empty()));
    let wide = Case::new(2, 1.8);
    let found = windows(wide, RANGE, SCAN);
    statements.push(Statement::new(
        place,
        "in the plane, h 1.8 dx: some epsilon is stable",
        format!("stable for {}", shown(&found)),
        !found.is_empty(),
    ));
    for (epsilon, stable) in [(strand::PLANE_WIDE_STABLE, true), (strand::PLANE_WIDE_UNSTABLE, false)] {
        let growth = wide.epsilon(epsilon).growth();
        statements.push(Statement::new(
            place,
            format!("in the plane, h 1.8 dx: epsilon {epsilon} is {}stable", if stable { "" } else { "un" }),
            if growth < STABLE {
                "stable".into()
            } else {
                format!("grows at {} c/dx, {} without", digits(growth), digits(wide.growth()))
            },
            (growth < STABLE) == stable,
        ));
    }
    for (dimension, epsilon) in (1..).zip(strand::LIBERSKY) {
        let case = Case::new(dimension, 1.3);
        let (with, without) = (case.epsilon(epsilon).growth(), case.growth());
        statements.push(Statement::new(
            "5.1.3.2, p. 111 (Libersky)",
            format!("epsilon {epsilon} works in {dimension}D"),
            if with < STABLE { "stable".into() } else { format!("grows at {} c/dx, {} without", digits(with), digits(without)) },
            with < STABLE,
        ));
    }
    let windows: Vec<_> = (1..=3).map(|dimension| windows(Case::new(dimension, 1.8), RANGE, SCAN)).collect();
    let width = |w: &Vec<[f64; 2]>| w.iter().map(|[low, high]| high / low).fold(1.0, f64::max);
    statements.push(Statement::new(
        "5.1.3.7, p. 121",
        "in space the window of epsilon is likely narrower still than in the plane (not run)",
        format!("h 1.8 dx: 1D {}, 2D {}, 3D {}", shown(&windows[0]), shown(&windows[1]), shown(&windows[2])),
        width(&windows[2]) <= width(&windows[1]),
    ));
    statements
}

/// Within a part of the published number.
pub fn near(found: f64, published: f64, part: f64) -> bool {
    (found / published - 1.0).abs() < part
}
