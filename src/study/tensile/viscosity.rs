//! Bond viscosity: whether it changes the epsilon that is needed, and what it does to two rods that collide; 5.1.3.5.
//!
//! Johnson's viscosity acts on approach. In a sawtooth of velocities every pair at an odd distance approaches on one
//! side of a particle and parts on the other, so that exactly half of a viscosity of all pairs acts, gamma, and
//! s^2 + gamma s = lambda: s > 0 exactly where lambda > 0. For longer waves that is an estimate, good near the sawtooth.

use super::case::Case;
use super::draw::{chart, curve, dots};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::particles::{Block, Row, Rule, border, growth};
use super::windows::{RANGE, digits, logarithmic, windows};
use crate::backend::Choice;
use crate::run::{Options, Stop, run};
use crate::scene::Scene;
use crate::study::chart::{Axis, Table};
use crate::study::von_neumann::{Damage, Viscous, Waves as _};
use glam::{DMat3, DVec3};
use std::f64::consts::PI;

/// C_L, C_Q and softening of the stronger setting.
pub const STRONG: [f64; 3] = [1.0, 2.0, 0.01];
const WEAK: [f64; 3] = [0.1, 0.2, 0.01];

/// gamma of a wave, in c/dx.
fn damping(case: Case, [linear, _, softening]: [f64; 3], k: f64) -> f64 {
    Viscous::new(&case.lattice(), DMat3::IDENTITY, &Damage::default(), linear, softening).rate([k, 0.0, 0.0], DVec3::X)
}

/// Growth rate of a wave on a line with a bond viscosity, in c/dx; 0 where it is stable.
pub fn viscous(case: Case, viscosity: [f64; 3], k: f64) -> f64 {
    let Some(equations) = case.equations() else { return f64::INFINITY };
    let lambda = equations.stiffness([k, 0.0, 0.0]).x_axis.x;
    let half = 0.5 * damping(case, viscosity, k);
    // Not the difference of the root and the half, which would lose its digits where lambda is small.
    if lambda <= 0.0 { 0.0 } else { lambda / ((half * half + lambda).sqrt() + half) }
}

const SIDE: usize = 61;

/// The standing wave of a line that grows fastest: its half waves and its rate.
pub fn fastest(case: Case, viscosity: [f64; 3]) -> (usize, f64) {
    let free = SIDE - 2 * border(case, Rule::default());
    let rate = |m: usize| (m, viscous(case, viscosity, PI * m as f64 / (free + 1) as f64));
    (1..=free).map(rate).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((1, 0.0))
}

/// Measured growth rate of that wave over 8 e-foldings, in c/dx.
pub fn measured(case: Case, viscosity: [f64; 3]) -> f64 {
    let (m, rate) = fastest(case, viscosity);
    let rule = Rule { viscosity: Some(viscosity), ..Rule::default() };
    let rows = Block::new(case, rule, SIDE, 0.0).standing(m, 1e-9).run(8.0 / rate, 40, 0.2_f64.min(0.05 / rate));
    growth(&rows.iter().map(|row| (row.time, row.speed)).collect::<Vec<_>>(), 4.0 / rate)
}

/// A kicked line.
fn line(epsilon: f64, viscosity: Option<[f64; 3]>, duration: f64) -> Vec<Row> {
    let rule = Rule { viscosity, ..Rule::default() };
    Block::new(Case::new(1, 1.3).epsilon(epsilon), rule, SIDE, 2e-10).run(duration, 100, 0.2)
}

pub fn viscosity() -> Result<Findings, Stop> {
    let settings = [("none", [0.0; 3]), ("0.1, 0.2", WEAK), ("1, 2", STRONG)];
    let epsilons = [0.0, 0.01, 0.02, 0.03, 0.04];
    let scan = logarithmic([1e-3, 1.0], 201);
    let mut rows = Vec::new();
    let mut series = Vec::new();
    for (colour, (word, coefficients)) in settings.into_iter().enumerate() {
        series.push(curve(
            format!("theory, {word}"),
            colour,
            scan.iter().map(|&e| [e, viscous(Case::new(1, 1.3).epsilon(e), coefficients, PI)]).collect(),
        ));
        let mut points = Vec::new();
        for epsilon in epsilons {
            let case = Case::new(1, 1.3).epsilon(epsilon);
            let ((_, theory), found) = (fastest(case, coefficients), measured(case, coefficients));
            points.push([epsilon, found]);
            rows.push(vec![
                word.to_string(),
                epsilon.to_string(),
                digits(theory),
                digits(found),
                format!("{:+.1} %", 100.0 * (found / theory - 1.0)),
            ]);
        }
        series.push(dots(format!("runs, {word}"), colour, points.split_off(1), Vec::new()));
    }
    let threshold = Exhibit {
        stem: "viscosity".into(),
        heading: "Bond viscosity and the epsilon that is needed".into(),
        text: vec![
            "Growth of a sawtooth on a line, h 1.3 dx, V 1.01, n 4, dp initial, for the coefficients C_L, C_Q, and of the fastest \
             standing wave of 61 particles, in theory and run. Viscosity slows the growth; where it ends is the same, as the \
             motion there is infinitely slow."
                .into(),
        ],
        pictures: vec![chart(
            "Growth with bond viscosity on a line",
            "h 1.3 dx, V 1.01. A curve at the lower end is stable.",
            Axis::log("epsilon").within([1e-3, 0.1]),
            Axis::log("growth rate, c/dx").within([1e-3, 1.0]),
            series,
        )],
        table: Some(Table { columns: table_columns(&["C_L, C_Q", "epsilon", "theory, c/dx", "run", "difference"]), rows }),
    };
    let (rods, rod_statement) = rods()?;
    let mut statements = line_statements();
    statements.push(rod_statement);
    Ok(Findings { exhibits: vec![threshold, rods], statements })
}

pub fn line_statements() -> Vec<Statement> {
    let least = windows(Case::new(1, 1.3), RANGE, 141)[0][0];
    // Well past the time in which the plain method grows by ten e-foldings.
    let grows = |epsilon: f64, viscosity| {
        let rows = line(epsilon, viscosity, 1500.0);
        rows[rows.len() - 1].speed > 3.0 * rows[0].speed
    };
    let runs = [0.5 * least, 1.1 * least].map(|epsilon| [grows(epsilon, None), grows(epsilon, Some(STRONG))]);
    let word = |grew: bool| if grew { "grows" } else { "does not" };
    let damped = line(1.119, Some(STRONG), 1500.0);
    let free = line(1.119, None, 1500.0);
    let kept = |rows: &[Row]| rows[rows.len() - 1].kinetic / rows[0].kinetic;
    let rises = damped.windows(2).filter(|pair| pair[1].kinetic > pair[0].kinetic).count();
    let place = "5.1.3.5 and figure 5.1-9, p. 117";
    vec![
        Statement::new(
            place,
            "bond viscosity leaves the least stable epsilon where it is",
            format!(
                "{} with and without; runs at 0.5 of it: without viscosity it {}, with it {}; at 1.1 of it: {}, {}",
                digits(least),
                word(runs[0][0]),
                word(runs[0][1]),
                word(runs[1][0]),
                word(runs[1][1])
            ),
            runs == [[true, true], [false, false]],
        ),
        Statement::new(
            place,
            "at epsilon 1.119 the kinetic energy decays, in oscillation, with the viscosity",
            format!(
                "{} of it are left after 1500 dx/c, {} without viscosity; it rises in {rises} of 100 intervals",
                digits(kept(&damped)),
                digits(kept(&free))
            ),
            kept(&damped) < 0.1 * kept(&free) && rises > 0,
        ),
    ]
}

const RODS: &str = include_str!("../../../scenes/rod_impact.toml");

/// Stress along the two rods at 400 us; figure 5.1-8.
fn rods() -> Result<(Exhibit, Statement), Stop> {
    let mut rows = Vec::new();
    let mut series = Vec::new();
    let mut found = Vec::new();
    for (colour, (word, [linear, quadratic, softening])) in [("0.1, 0.2", WEAK), ("1, 2", STRONG)].into_iter().enumerate() {
        let viscosity =
            format!("formulation.viscosity={{ alpha = {linear:?}, beta = {quadratic:?}, softening = {softening:?} }}");
        let overrides = ["duration=400e-6".to_string(), "output.frames=0".into(), viscosity];
        let scene = Scene::parse(RODS, "rod_impact", None, &overrides).map_err(Stop::Failed)?;
        let options = Options { choice: Choice::Cpu, dry: true, quiet: true, energy: Options::UNWATCHED, ..Options::default() };
        let finished = run(&scene, &options)?;
        let trace = finished.profiles.get("stress").cloned().unwrap_or_default();
        // His units are centimetres and megabars.
        let points: Vec<[f64; 2]> = trace.iter().map(|(x, stress)| [100.0 * x, stress * 1e-11]).collect();
        rows.extend(points.iter().map(|[x, stress]| vec![word.to_string(), format!("{x:.3}"), format!("{stress:.6}")]));
        found.push(points.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs()).sum::<f64>());
        series.push(curve(word, colour, points));
    }
    let exhibit = Exhibit {
        stem: "rod-impact".into(),
        heading: "Two rods that collide".into(),
        text: vec![
            "Stress along both rods 400 us after they touch, for two settings of C_L and C_Q. The thesis prints no material: \
             steel with sound at 5000 m/s, run by the program from scenes/rod_impact.toml."
                .into(),
        ],
        pictures: vec![chart(
            "Stress along the rods at 400 us",
            "",
            Axis::linear("x, cm"),
            Axis::linear("stress xx, Mbar"),
            series,
        )],
        table: Some(Table { columns: table_columns(&["C_L, C_Q", "x, cm", "stress xx, Mbar"]), rows }),
    };
    let statement = Statement::new(
        "figure 5.1-8, p. 116",
        "the larger coefficients smooth the trace",
        format!("its rises and falls sum to {} and {} Mbar", digits(found[0]), digits(found[1])),
        found[1] < 0.7 * found[0],
    );
    Ok((exhibit, statement))
}
