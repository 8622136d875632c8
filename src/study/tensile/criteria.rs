//! Both criteria of a partition of unity against the thesis: their estimates of unity, and tables 5.2-1 and 5.2-2.

use super::case::Case;
use super::draw::{chart, curve};
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::partition::{Criterion, Equation, Partition, Unity, growth};
use super::published as strand;
use super::windows::digits;
use crate::study::chart::{Axis, Picture, Table};
use rayon::prelude::*;

/// What the estimates of unity are on the undisturbed lattice.
pub fn estimates() -> Vec<Statement> {
    let lattice = Case::new(2, strand::LOCAL_RATIO).lattice();
    let of =
        |unity: Unity, scale: f64| Partition::new(Criterion::Neighbourhood, Equation::Momentum, unity, scale).estimate(&lattice);
    let local = of(Unity::Local, 1.5);
    let list = |unity: Unity| strand::SCALES.map(|scale| of(unity, scale));
    let words = |found: [f64; 4]| found.map(|x| format!("{x:.5}")).join(", ");
    let rings = strand::SCALES
        .map(|scale| Partition::new(Criterion::Neighbourhood, Equation::Momentum, Unity::Ring, scale).ring(&lattice));
    let whole = list(Unity::Whole);
    let ring = list(Unity::Ring);
    vec![
        Statement::new(
            "table 5.2-2 and figure 5.2-3, p. 132-133",
            format!("non-local neighbours for lambda 1.25 .. 2: {:?}", strand::RING),
            format!("{rings:?}, those at exactly 2 h with them"),
            rings == strand::RING,
        ),
        Statement::new(
            "5.2.3.1, p. 133",
            format!("local estimate of unity near the centre {}", strand::UNITY),
            format!("{local:.5} on the undisturbed lattice at h {} dx", strand::LOCAL_RATIO),
            (local - strand::UNITY).abs() < 5e-4,
        ),
        Statement::new(
            "5.2.3.1, p. 133",
            "1 minus the local estimate is far below 1, so that the non-local part hardly counts",
            format!("{:.1e}", 1.0 - local),
            (1.0 - local).abs() < 0.01,
        ),
        Statement::new(
            "5.2.3.1, p. 133",
            format!("non-local estimate of every particle not on the border {}", strand::UNITY_NONLOCAL),
            format!("{} for lambda 1.25 .. 2 over all that the wide kernel reaches", words(whole)),
            whole.iter().any(|x| (x - strand::UNITY_NONLOCAL).abs() < 1e-4),
        ),
        Statement::new(
            "5.2.3, p. 131, the equation of the non-local estimate",
            format!("summed over the neighbours beyond the local ones, {}", strand::UNITY_NONLOCAL),
            format!("{}: that sum leaves out the near ones and cannot be near 1", words(ring)),
            ring.iter().any(|x| (x - 1.0).abs() < 0.1),
        ),
    ]
}

/// A change of the growth rate, relative to the control, that his plots over some 15 e-foldings would show as half an e-folding.
pub const VISIBLE: f64 = 0.5 / 15.0;

/// The test in the plane, and what the growth becomes with a partition.
struct Test {
    case: Case,
    /// Growth rate of the plain method, c/dx.
    control: f64,
    rows: Vec<Vec<String>>,
}

impl Test {
    fn new() -> Self {
        let case = Case::new(2, strand::LOCAL_RATIO);
        Self { case, control: growth(case, None), rows: Vec::new() }
    }

    /// Change of the growth rate, relative to the control.
    fn change(&self, partition: Partition) -> f64 {
        growth(self.case, Some(partition)) / self.control - 1.0
    }

    /// Changes for his four factors lambda; each becomes a row.
    fn changes(&mut self, partition: Partition) -> [f64; 4] {
        strand::SCALES.map(|scale| {
            let partition = Partition { scale, ..partition };
            let change = self.change(partition);
            self.rows.push(vec![
                format!("{:?}", partition.criterion),
                format!("{:?}", partition.equation),
                format!("{:?}", partition.unity),
                partition.scale.to_string(),
                partition.factor.to_string(),
                if partition.swapped { "yes".into() } else { String::new() },
                format!("{:.5}", partition.estimate(&self.case.lattice())),
                format!("{:.5}", self.control * (1.0 + change)),
                format!("{:+.3} %", 100.0 * change),
            ]);
            change
        })
    }

    /// That there is no effect to be seen.
    fn unseen(&mut self, place: &'static str, claim: String, partition: Partition) -> Statement {
        let changes = self.changes(partition);
        let seen = changes.iter().any(|change| change.abs() > VISIBLE);
        Statement::new(place, claim + ", lambda 1.25 .. 2: no effect", in_words(changes), !seen)
    }

    /// Change over lambda, percent.
    fn curves(&self, equation: Equation) -> Picture {
        let scales: Vec<f64> = (0..=25).map(|k| 1.0 + 0.04 * f64::from(k)).collect();
        let series = kinds(equation).into_iter().enumerate().map(|(colour, (_, name, partition))| {
            let point = |&scale: &f64| [scale, 100.0 * self.change(Partition { scale, ..partition })];
            curve(name, colour, scales.par_iter().map(point).collect())
        });
        chart(
            &format!("Change of the growth rate, {}", name(equation)),
            "2D, V 1.01. Strand sees no change.",
            Axis::linear("lambda"),
            Axis::linear("change, %"),
            series.collect(),
        )
    }
}

fn in_words(changes: [f64; 4]) -> String {
    format!("growth rate changed by {} %", changes.map(|change| format!("{:+.2}", 100.0 * change)).join(", "))
}

fn name(equation: Equation) -> &'static str {
    match equation {
        Equation::Momentum => "momentum equation",
        Equation::StrainRate => "strain rate equation",
    }
}

/// What tables 5.2-1 and 5.2-2 apply to an equation: where, its name, and the partition at any lambda.
fn kinds(equation: Equation) -> [(&'static str, &'static str, Partition); 4] {
    let (first, second) = ("table 5.2-1 and figure 5.2-1, p. 127-128", "table 5.2-2 and figure 5.2-4, p. 132-134");
    let of = |criterion, unity| Partition::new(criterion, equation, unity, 1.0);
    [
        (first, "Smoothing Length Criterion", of(Criterion::SmoothingLength, Unity::Local)),
        (second, "Neighbourhood Criterion, local estimate", of(Criterion::Neighbourhood, Unity::Local)),
        (second, "Neighbourhood Criterion, non-local estimate (whole)", of(Criterion::Neighbourhood, Unity::Whole)),
        (second, "Neighbourhood Criterion, non-local estimate (as printed, the ring)", of(Criterion::Neighbourhood, Unity::Ring)),
    ]
}

/// All tests of tables 5.2-1 and 5.2-2, and two that the thesis leaves open.
pub fn criteria() -> Findings {
    let mut test = Test::new();
    let mut statements = Vec::new();
    for equation in [Equation::Momentum, Equation::StrainRate] {
        for (place, kind, partition) in kinds(equation) {
            statements.push(test.unseen(place, format!("{kind}, {}", name(equation)), partition));
        }
    }
    let plain = |criterion| Partition::new(criterion, Equation::Momentum, Unity::Local, 1.0);
    let amplified = Partition { factor: 10.0, ..plain(Criterion::Neighbourhood) };
    statements.push(test.unseen("5.2.3.1, p. 134", "a factor 10 on the non-local part of the momentum".into(), amplified));
    let exchanged = [Criterion::SmoothingLength, Criterion::Neighbourhood]
        .map(|criterion| format!("{criterion:?}: {}", in_words(test.changes(Partition { swapped: true, ..plain(criterion) }))));
    let columns = [
        "criterion",
        "equation",
        "estimate of unity over",
        "lambda",
        "factor",
        "exchanged",
        "estimate",
        "growth, c/dx",
        "change",
    ];
    let text = vec![
        format!(
            "Swegle's block in the plane, V 1.01, local h {} dx; the control grows at {} c/dx. On a lattice to first order \
             the criteria only mix the gradients of two kernels by fixed weights, as all free particles have whole \
             neighbourhoods. The fastest wave has no strain rate, so that nothing changes there. A change below {:.1} % \
             does not show in a plot over 15 e-foldings.",
            strand::LOCAL_RATIO,
            digits(test.control),
            100.0 * VISIBLE
        ),
        format!("With the weights exchanged, which 5.2.4 (p. 135-136) leaves open: {}.", exchanged.join("; ")),
    ];
    let exhibit = Exhibit {
        stem: "partition".into(),
        heading: "Partitions of unity".into(),
        text,
        pictures: [Equation::Momentum, Equation::StrainRate].map(|equation| test.curves(equation)).into(),
        table: Some(Table { columns: table_columns(&columns), rows: test.rows }),
    };
    Findings { exhibits: vec![exhibit], statements }
}
