//! Both criteria of a partition of unity against the thesis: their estimates of unity, and tables 5.2-1 and 5.2-2.

use super::case::Case;
use super::findings::{Exhibit, Findings, Statement, table_columns};
use super::partition::{Criterion, Equation, Partition, Unity, growth};
use super::published as strand;
use super::windows::digits;
use crate::study::chart::Table;

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

/// All tests of tables 5.2-1 and 5.2-2, and two that the thesis leaves open.
pub fn criteria() -> Findings {
    let case = Case::new(2, strand::LOCAL_RATIO);
    let lattice = case.lattice();
    let control = growth(case, None);
    let mut rows = Vec::new();
    let mut largest = |place: &'static str, claim: &str, list: Vec<Partition>, visible: bool| {
        let changes: Vec<f64> = list
            .iter()
            .map(|&partition| {
                let rate = growth(case, Some(partition));
                rows.push(vec![
                    format!("{:?}", partition.criterion),
                    format!("{:?}", partition.equation),
                    format!("{:?}", partition.unity),
                    partition.scale.to_string(),
                    partition.factor.to_string(),
                    if partition.swapped { "yes".into() } else { String::new() },
                    format!("{:.5}", partition.estimate(&lattice)),
                    format!("{rate:.5}"),
                    format!("{:+.3} %", 100.0 * (rate / control - 1.0)),
                ]);
                rate / control - 1.0
            })
            .collect();
        let words = changes.iter().map(|c| format!("{:+.2}", 100.0 * c)).collect::<Vec<_>>().join(", ");
        let seen = changes.iter().any(|change| change.abs() > VISIBLE);
        Statement::new(place, claim, format!("growth rate changed by {words} %"), seen == visible)
    };
    let all = |criterion, equation, unity| -> Vec<Partition> {
        strand::SCALES.iter().map(|&scale| Partition::new(criterion, equation, unity, scale)).collect()
    };
    let mut statements = Vec::new();
    for (equation, name) in [(Equation::Momentum, "momentum"), (Equation::StrainRate, "strain rate")] {
        statements.push(largest(
            "table 5.2-1 and figure 5.2-1, p. 127-128",
            &format!("Smoothing Length Criterion on the {name}, lambda 1.25 .. 2: no effect"),
            all(Criterion::SmoothingLength, equation, Unity::Local),
            false,
        ));
        for (unity, words) in [
            (Unity::Local, "local"),
            (Unity::Whole, "non-local (whole)"),
            (Unity::Ring, "non-local (as printed, the ring alone)"),
        ] {
            statements.push(largest(
                "table 5.2-2 and figure 5.2-4, p. 132-134",
                &format!("Neighbourhood Criterion on the {name}, {words} estimate, lambda 1.25 .. 2: no effect"),
                all(Criterion::Neighbourhood, equation, unity),
                false,
            ));
        }
    }
    let amplified = all(Criterion::Neighbourhood, Equation::Momentum, Unity::Local);
    let amplified = amplified.into_iter().map(|partition| Partition { factor: 10.0, ..partition }).collect();
    statements.push(largest("5.2.3.1, p. 134", "a factor 10 on the non-local part of the momentum: no effect", amplified, false));
    let swapped = |criterion| {
        let list = all(criterion, Equation::Momentum, Unity::Local);
        list.into_iter().map(|partition| Partition { swapped: true, ..partition }).collect::<Vec<_>>()
    };
    let open = "5.2.4, p. 135-136";
    let turned = [Criterion::SmoothingLength, Criterion::Neighbourhood].map(|criterion| {
        largest(open, &format!("{criterion:?} with the weights exchanged: left open"), swapped(criterion), true)
    });
    // Nothing published to agree with: these go into the words instead.
    let open = turned.map(|statement| format!("{}, here: {}.", statement.published, statement.found));
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
    let exhibit = Exhibit {
        stem: "partition".into(),
        heading: "Partitions of unity".into(),
        text: [
            vec![format!(
                "Swegle's block in the plane, V 1.01, local h {} dx; the control grows at {} c/dx. On a lattice to first order \
                 the criteria only mix the gradients of two kernels by fixed weights. A change below {:.1} % does not show in \
                 a plot over 15 e-foldings.",
                strand::LOCAL_RATIO,
                digits(control),
                100.0 * VISIBLE
            )],
            open.to_vec(),
        ]
        .concat(),
        table: Some(Table { columns: table_columns(&columns), rows }),
        ..Exhibit::default()
    };
    Findings { exhibits: vec![exhibit], statements }
}
