//! The repulsive force on a line: what the thesis says of epsilon, h and dp, and what comes out.

use super::case::{Case, Form};
use super::findings::{Statement, near};
use super::published as strand;
use super::windows::{RANGE, digits, shown, windows};

/// Points of the scans for windows.
const SCAN: usize = 141;

pub fn line_statements() -> Vec<Statement> {
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
