//! The repulsive force in compression: whether the lattice needs it there, and what either sign of it does; 5.1.3.6.

use super::case::{Case, Form, STABLE};
use super::draw::{chart, curve, dashed};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::published as strand;
use super::windows::{RANGE, calmest, digits, logarithmic, shown, windows};
use crate::study::chart::{Axis, Table};
use rayon::prelude::*;

const SCAN: usize = 101;
/// Relative volumes of the table; the first is that of his figure 5.1-3.
const VOLUMES: [f64; 3] = [0.999, 0.99, 0.95];
/// The two signs, in words.
const SIGNS: [(Form, &str); 2] = [(Form::Opposed, "repels"), (Form::Signed, "attracts")];

pub fn compression() -> Findings {
    let mut rows = Vec::new();
    for (dimension, ratio) in [(1, 1.3), (1, 1.8), (2, 1.3), (2, 1.52), (2, 1.8), (3, 1.3), (3, 1.8)] {
        for volume in VOLUMES {
            let case = Case::new(dimension, ratio).volume(volume);
            let plain = case.growth();
            let mut row = vec![dimension.to_string(), ratio.to_string(), volume.to_string(), digits(zeroed(plain))];
            row.push(digits(zeroed(Case::new(dimension, ratio).volume(2.0 - volume).growth())));
            for (form, _) in SIGNS {
                let (best, least) = calmest(case.form(form), RANGE, SCAN);
                row.push(shown(&windows(case.form(form), RANGE, SCAN)));
                row.push(format!("{} at {}", digits(zeroed(least)), digits(best)));
            }
            rows.push(row);
        }
    }
    let columns = [
        "dimension",
        "h/dx",
        "V",
        "growth, c/dx",
        "in as much tension",
        "stable epsilon, repelling",
        "least growth",
        "stable epsilon, attracting",
        "least growth",
    ];
    let scan = logarithmic(RANGE, 121);
    let pictures = [1.3, 1.8].map(|ratio| {
        let case = Case::new(2, ratio).volume(0.99);
        let grown = |form: Form| scan.par_iter().map(|&e| [e, case.form(form).epsilon(e).growth()]).collect();
        let plain = case.growth();
        let mut series: Vec<_> = SIGNS.iter().enumerate().map(|(k, (form, word))| curve(*word, k, grown(*form))).collect();
        series.push(dashed("no repulsive force", 2, vec![[RANGE[0], plain], [RANGE[1], plain]]));
        chart(
            &format!("Repulsive force in compression: 2D, V 0.99, h {ratio} dx"),
            "A curve at the lower end is stable.",
            Axis::log("epsilon"),
            Axis::log("largest growth rate, c/dx").within([1e-3, 1e2]),
            series,
        )
    });
    let exhibit = Exhibit {
        stem: "compression".into(),
        heading: "The repulsive force in compression".into(),
        text: vec![
            "A compressed lattice of fluid is unstable to shear that brings no neighbour nearer (the zero-energy mode), \
             at every h in 2D and 3D. Active in compression the force can keep its sign (|P|: it repels still) or take that \
             of the stress (tr(sigma), as the thesis prints it: it attracts)."
                .into(),
        ],
        pictures: pictures.into(),
        table: Some(Table { columns: table_columns(&columns), rows }),
    };
    Findings { exhibits: vec![exhibit], statements: statements() }
}

fn zeroed(growth: f64) -> f64 {
    if growth < STABLE { 0.0 } else { growth }
}

/// c/dx of the steel of his test, 1/s: 5000 m/s over 1 mm. The thesis prints neither material nor speed of sound.
pub const UNIT_RATE: f64 = 5e6;

pub fn statements() -> Vec<Statement> {
    let mut statements = Vec::new();
    let quiet = Case::new(2, 1.3).volume(VOLUMES[0]).growth() * UNIT_RATE * strand::CLUMPED;
    statements.push(Statement::new(
        "figure 5.1-3, p. 107-108",
        "in the plane, h 1.3 dx, V 0.999: nothing grows while V 1.05 clumps (12 us)",
        format!("it grows, by {} e-foldings in 12 us with c 5000 m/s: not to be seen", digits(quiet)),
        quiet < 1.0,
    ));
    let place = "5.1.3.6 and figure 5.1-11, p. 119-120";
    let wide = Case::new(2, 1.8).volume(0.99);
    let (narrow_rate, wide_rate) = (Case::new(2, 1.3).volume(0.99).growth(), wide.growth());
    statements.push(Statement::new(
        place,
        "in the plane, h 1.8 dx: unstable in compression too",
        format!("grows at {} c/dx at V 0.99", digits(wide_rate)),
        wide_rate > STABLE,
    ));
    statements.push(Statement::new(
        "5.1.1 footnote 4, p. 105, and 3.3.1 footnote 1, p. 55",
        "in compression it is unstable for large smoothing lengths only, such as 1.8 dx",
        format!("at V 0.99 it grows at {} c/dx at h 1.3 dx and at {} at 1.8", digits(narrow_rate), digits(wide_rate)),
        narrow_rate < STABLE,
    ));
    for (form, word) in SIGNS {
        let found = windows(wide.form(form), RANGE, SCAN);
        let (best, least) = calmest(wide.form(form), RANGE, SCAN);
        statements.push(Statement::new(
            place,
            format!("active in compression no epsilon makes it stable there (if it {word})"),
            format!("stable for {}; least growth {} c/dx at epsilon {}", shown(&found), digits(zeroed(least)), digits(best)),
            found.is_empty(),
        ));
    }
    statements
}
