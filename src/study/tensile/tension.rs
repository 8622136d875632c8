//! Growth and windows of epsilon over the tension; section 5.1.3.7, figures 5.1-3 and 5.1-12.

use super::case::{Case, STABLE};
use super::draw::{chart, curve, dashed, dots};
use super::findings::{Exhibit, Findings, Statement, near, table_columns};
use super::published as strand;
use super::windows::{RANGE, calmest, digits, logarithmic, shown, windows};
use crate::study::chart::{Axis, Table};
use rayon::prelude::*;

/// Growth over tension without a repulsive force, and the windows that move with it; figures 5.1-3 and 5.1-12.
pub fn tension() -> Findings {
    let strains = logarithmic([1e-4, 0.1], 61);
    let growth = |dimension: usize| -> Vec<[f64; 2]> {
        strains.par_iter().map(|&strain| [strain, Case::new(dimension, 1.3).volume(1.0 + strain).growth()]).collect()
    };
    let plain = chart(
        "Growth over tension, h 1.3 dx",
        "Nearly as the root of the tension.",
        Axis::log("V - 1"),
        Axis::log("growth rate, c/dx"),
        (1..=3).map(|dimension| curve(format!("{dimension}D"), dimension - 1, growth(dimension))).collect(),
    );
    let volumes = logarithmic([1e-4, 0.1], 25);
    let found: Vec<(f64, Vec<[f64; 2]>)> =
        volumes.iter().map(|&strain| (strain, windows(Case::new(2, 1.8).volume(1.0 + strain), [1e-3, 1e2], 201))).collect();
    let ends = |end: usize| found.iter().flat_map(|(strain, list)| list.iter().map(move |w| [*strain, w[end]])).collect();
    let published = strand::TENSIONS_STABLE.map(|volume| [volume - 1.0, strand::TENSION_EPSILON]).to_vec();
    let moving = chart(
        "Window of epsilon over tension, 2D, h 1.8 dx",
        "n 4, dp initial. Where there is no dot no epsilon is stable.",
        Axis::log("V - 1"),
        Axis::log("epsilon").within([0.1, 3.0]),
        vec![
            dots("least stable", 0, ends(0), Vec::new()),
            dots("most", 1, ends(1), Vec::new()),
            dots("Strand: stable", 3, published, Vec::new()),
            dashed(
                "Strand: calmest at 1.001",
                4,
                vec![[0.0007, strand::TENSION_UNSTABLE.1], [0.0014, strand::TENSION_UNSTABLE.1]],
            ),
        ],
    );
    let with: Vec<f64> = found.iter().filter(|(_, list)| !list.is_empty()).map(|(strain, _)| 1.0 + strain).collect();
    let between = match with[..] {
        [first, .., last] => format!("from V {first:.4} to {last:.4}"),
        _ => "nowhere".into(),
    };
    let exhibit = Exhibit {
        stem: "tension".into(),
        heading: "Growth and windows over the tension".into(),
        text: vec![format!(
            "The growth follows the root of the tension. The window of epsilon in the plane stays where it is, as the force is \
                 in proportion to the tension, but there is one only {between}: in weaker tension the stiffness that the force \
                 takes in bulk outweighs what it adds."
        )],
        pictures: vec![plain, moving],
        table: Some(table()),
    };
    Findings { exhibits: vec![exhibit], statements: tension_statements() }
}

/// Windows in 1D, 2D and 3D at the volumes of the thesis and some between.
fn table() -> Table {
    let mut rows = Vec::new();
    for (dimension, ratio) in [(1, 1.3), (1, 1.8), (2, 1.3), (2, 1.8), (3, 1.3), (3, 1.8)] {
        for volume in [0.999, 1.001, 1.003, 1.01, 1.03, 1.05] {
            let case = Case::new(dimension, ratio).volume(volume);
            let (best, least) = calmest(case, RANGE, 141);
            let zeroed = |growth: f64| digits(if growth < STABLE { 0.0 } else { growth });
            let mut row = vec![dimension.to_string(), ratio.to_string(), volume.to_string(), zeroed(case.growth())];
            row.extend(if volume < 1.0 {
                [String::new(), String::new(), String::new()]
            } else {
                [shown(&windows(case, RANGE, 141)), digits(best), zeroed(least)]
            });
            rows.push(row);
        }
    }
    let columns = ["dimension", "h/dx", "V", "growth without, c/dx", "stable epsilon", "calmest epsilon", "its growth"];
    Table { columns: table_columns(&columns), rows }
}

pub fn tension_statements() -> Vec<Statement> {
    let mut statements = Vec::new();
    let wide = |volume: f64| Case::new(2, 1.8).volume(volume);
    let place = "5.1.3.7 and figure 5.1-12, p. 121-122";
    for volume in strand::TENSIONS_STABLE {
        let growth = wide(volume).epsilon(strand::TENSION_EPSILON).growth();
        statements.push(Statement::new(
            place,
            format!("in the plane, h 1.8 dx, V {volume}: epsilon {} is stable", strand::TENSION_EPSILON),
            if growth < STABLE {
                "stable".into()
            } else {
                let found = windows(wide(volume), [1e-3, 1e2], 201);
                format!(
                    "grows at {} c/dx, {} without; stable for {}",
                    digits(growth),
                    digits(wide(volume).growth()),
                    shown(&found)
                )
            },
            growth < STABLE,
        ));
    }
    let (volume, published) = strand::TENSION_UNSTABLE;
    let found = windows(wide(volume), [1e-3, 1e2], 401);
    let (best, least) = calmest(wide(volume), [1e-3, 1e2], 201);
    statements.push(Statement::new(
        place,
        format!("in the plane, h 1.8 dx, V {volume}: no epsilon is stable"),
        format!("stable for {}; least growth {} c/dx of {} without", shown(&found), digits(least), digits(wide(volume).growth())),
        found.is_empty(),
    ));
    statements.push(Statement::new(
        place,
        format!("the calmest epsilon there is {published}"),
        digits(best),
        near(best, published, 0.3),
    ));
    let least: Vec<Option<f64>> =
        strand::TENSIONS_STABLE.iter().map(|&volume| windows(wide(volume), [1e-3, 1e2], 201).first().map(|w| w[0])).collect();
    let words: Vec<String> = least.iter().map(|low| low.map_or("none".into(), digits)).collect();
    statements.push(Statement::new(
        place,
        "the least stable epsilon rises with the tension",
        format!("{} at V {:?}", words.join(", "), strand::TENSIONS_STABLE),
        least.windows(2).all(|pair| matches!(pair, [Some(a), Some(b)] if *b > 1.01 * a)),
    ));
    let rates: Vec<f64> = [1.001, 1.01, 1.05].iter().map(|&volume| Case::new(2, 1.3).volume(volume).growth()).collect();
    statements.push(Statement::new(
        "figure 5.1-3, p. 108",
        "the instability grows faster with more tension",
        format!("{} c/dx at V 1.001, 1.01, 1.05", rates.iter().map(|&r| digits(r)).collect::<Vec<_>>().join(", ")),
        rates.is_sorted(),
    ));
    statements
}
