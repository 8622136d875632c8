//! The work of the repulsive force: in Swegle's test, as the thesis sums it and as force times way, and on closed paths;
//! section 5.1.3.4.

use super::case::Case;
use super::draw::{chart, curve};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::particles::{Block, Row, Rule};
use super::published as strand;
use super::windows::digits;
use crate::study::chart::{Axis, Table};
use crate::study::von_neumann::Waves as _;
use glam::DVec3;

/// rho0 c^2 dx A in J for steel, dx 1 mm and a line of 1 cm^2: 7850 x 5000^2 x 1e-3 x 1e-4.
const ENERGY: f64 = 19625.0;
const KICK: f64 = 2e-10;
const SIDE: usize = 51;

/// A kicked line for 300 dx/c, 60 us.
pub fn swegle(epsilon: f64) -> Vec<Row> {
    Block::new(Case::new(1, 1.3).epsilon(epsilon), Rule::default(), SIDE, KICK).run(300.0, 150, 0.1)
}

/// Part of the stiffness in bulk that is left: the squared speed of long waves, relative to that without the force.
pub fn stiffness_left(case: Case) -> f64 {
    let wave = [1e-3, 0.0, 0.0];
    let of = |epsilon: f64| case.epsilon(epsilon).equations().map_or(0.0, |equations| equations.stiffness(wave).x_axis.x);
    of(case.epsilon) / of(0.0)
}

/// Work of the repulsive force on a line that is led through a path and back to its start, over the elastic energy at the
/// stretch of 1 %: at the turning point and at the end. The path either only stretches and returns, or displaces every other
/// particle by 0.1 dx while it is stretched and puts it back after the return.
pub fn led(epsilon: f64, displaced: bool) -> [f64; 2] {
    let case = Case::new(1, 1.3).volume(1.0).epsilon(epsilon);
    let mut block = Block::new(case, Rule::default(), SIDE, 0.0);
    let (steps, stretch, saw) = (400, 0.01, if displaced { 0.1 } else { 0.0 });
    let middle = (SIDE - 1) as f64 / 2.0;
    let place = |x: DVec3, strain: f64, shift: f64| {
        let sign = if x.x.rem_euclid(2.0) < 0.5 { 0.5 } else { -0.5 };
        DVec3::X * (middle + (x.x - middle) * (1.0 + strain) + sign * shift)
    };
    let mut turned = 0.0;
    for (k, [from, to]) in
        [[[0.0, 0.0], [stretch, 0.0]], [[stretch, 0.0], [stretch, saw]], [[stretch, saw], [0.0, saw]], [[0.0, saw], [0.0, 0.0]]]
            .into_iter()
            .enumerate()
    {
        for n in 1..=steps {
            let part = f64::from(n) / f64::from(steps);
            let at = |axis: usize| from[axis] + (to[axis] - from[axis]) * part;
            block.lead(|x| place(x, at(0), at(1)), 1.0);
        }
        if k == 1 {
            turned = block.row().work;
        }
    }
    let elastic = 0.5 * stretch * stretch * SIDE as f64;
    [turned / elastic, block.row().work / elastic]
}

pub fn work() -> Findings {
    let epsilons = [0.03, 0.3, 1.119, 1.3, 10.0];
    let mut rows = Vec::new();
    let mut runs = Vec::new();
    let mut series = Vec::new();
    for (colour, epsilon) in epsilons.into_iter().enumerate() {
        let case = Case::new(1, 1.3).epsilon(epsilon);
        let run = swegle(epsilon);
        let (first, last) = (run[0], run[run.len() - 1]);
        rows.push(vec![
            epsilon.to_string(),
            if case.is_stable() { "stable".into() } else { format!("grows at {} c/dx", digits(case.growth())) },
            format!("{:.2e}", last.work_of_lengths * ENERGY),
            format!("{:.2e}", last.work * ENERGY),
            format!("{:.2e}", last.kinetic / first.kinetic),
            digits(last.work_of_lengths / first.kinetic),
            format!("{:.3}", stiffness_left(case)),
        ]);
        let points = run[1..].iter().map(|row| [row.time, row.work_of_lengths * ENERGY]).collect();
        series.push(curve(format!("epsilon {epsilon}"), colour, points));
        runs.push((case.is_stable(), last, first));
    }
    let columns = [
        "epsilon",
        "theory",
        "work as printed, J",
        "force times way, J",
        "kinetic energy, of the kick's",
        "work as printed, of the kick's energy",
        "stiffness in bulk left",
    ];
    let swegle = Exhibit {
        stem: "work".into(),
        heading: "Work of the repulsive force".into(),
        text: vec![
            "Swegle's line of 51 particles of steel, 1 mm apart, 1 cm^2, over 60 us. The thesis multiplies the length of \
             the force by that of the step, so that its sum never falls; force times way is the work proper. The force adds \
             no strength in bulk: as it follows the pressure, it takes the part of the stiffness that the last column \
             leaves, and below zero the bulk collapses."
                .into(),
        ],
        pictures: vec![chart(
            "Work of the repulsive force on a line",
            "h 1.3 dx, V 1.01, n 4, dp initial; length of force times length of step.",
            Axis::linear("time, dx/c"),
            Axis::log("work, J"),
            series,
        )],
        table: Some(Table { columns: table_columns(&columns), rows }),
    };
    Findings { exhibits: vec![swegle, paths()], statements: statements(&runs) }
}

fn statements(runs: &[(bool, Row, Row)]) -> Vec<Statement> {
    let range = |stable: bool| {
        let list: Vec<f64> = runs.iter().filter(|run| run.0 == stable).map(|run| run.1.work_of_lengths * ENERGY).collect();
        (list.iter().copied().fold(f64::INFINITY, f64::min), list.iter().copied().fold(0.0, f64::max))
    };
    let ((low, high), (unstable, most)) = (range(true), range(false));
    let kick = runs[0].2.kinetic * ENERGY;
    // (V - 1)^2/2 a particle.
    let tension = 0.5 * 0.01 * 0.01 * SIDE as f64 * ENERGY;
    let left = stiffness_left(Case::new(1, 1.3).epsilon(0.3));
    let place = "5.1.3.4, p. 114-115";
    vec![
        Statement::new(
            place,
            format!(
                "the work of the force in a stable run on a line is negligible (about {:.0e} J, for a section not printed)",
                strand::WORK
            ),
            format!(
                "{low:.1e} to {high:.1e} J for 1 cm^2 as he sums it, {:.0e} of the elastic energy of the tension; the kick has {kick:.1e} J",
                high / tension
            ),
            high < 1e-9 * tension,
        ),
        Statement::new(
            place,
            "it is significant only where the run is unstable",
            format!("{unstable:.1e} to {most:.1e} J there"),
            unstable > 100.0 * high,
        ),
        Statement::new(
            place,
            "it was thought to add unphysical strength, which might explain the failure in the plane",
            format!("it takes strength: epsilon 0.3 leaves {} of the stiffness of a line in bulk", digits(left)),
            left > 1.0,
        ),
    ]
}

/// Closed paths.
fn paths() -> Exhibit {
    let rows = [0.1, 0.3, 1.0].map(|epsilon| {
        let [[out, back], [moved, around]] = [false, true].map(|displaced| led(epsilon, displaced));
        vec![epsilon.to_string(), digits(out), format!("{back:.1e}"), digits(moved), digits(around)]
    });
    let columns = [
        "epsilon",
        "stretched by 1 %",
        "and back",
        "stretched, then every other particle moved by 0.1 dx",
        "round the closed path",
    ];
    Exhibit {
        stem: "closed-paths".into(),
        heading: "Work on closed paths".into(),
        text: vec![
            "Work of the repulsive force on a line led along a path and back, over the elastic energy at 1 % stretch. \
             Stretching alone gives back what it takes. Round a path that stretches, moves every other particle, \
             returns and moves them back, work is left over: the force comes from no potential, and no sum of its work \
             is an energy that it holds."
                .into(),
        ],
        table: Some(Table { columns: table_columns(&columns), rows: rows.to_vec() }),
        ..Exhibit::default()
    }
}
