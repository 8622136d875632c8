//! The repulsive force in the plane and in space: what the thesis says of epsilon and h, and what comes out.

use super::case::{Case, STABLE, Spacing};
use super::findings::{Statement, near};
use super::published as strand;
use super::windows::{RANGE, calmest, digits, shown, windows};

/// Points of the scans for windows.
const SCAN: usize = 141;

pub fn plane_statements() -> Vec<Statement> {
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
