//! The sheared plate of Shutov & Klyuchantsev 2019, section 6.1, by their method: which of its readings give the
//! finite elements' answer, and how the others fail.

use crate::common::{scene_file, scene_folder};
use lithosph::backend::Choice;
use lithosph::output::csv;
use lithosph::run::{Finished, Options, Stop, run};
use lithosph::scene::Scene;
use std::collections::BTreeMap;

/// The paper's plate with so many particles a side.
fn run_plate(side: u32, changes: &[&str]) -> Result<Finished, Stop> {
    let corner = 0.5 - 0.5 / f64::from(side);
    let mut all = vec![format!("spacing={:.17}", 1.0 / f64::from(side))];
    // Readings of the method that make energy are run to their end.
    all.push("watch.energy='warn'".into());
    all.extend(["x", "y"].map(|axis| format!("observe.corner_{axis}.at=[{corner},{corner}]")));
    all.extend(changes.iter().map(|change| (*change).to_string()));
    let scene = Scene::open(&scene_file("sheared_plate_shutov"), None, &all).unwrap_or_else(|error| panic!("{error}"));
    run(&scene, &Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() })
}

/// Largest distance of the corner particle from the reference, in mm, and largest change of the energy over its first
/// value.
fn errors(side: u32, changes: &[&str]) -> (f64, f64) {
    let table = run_plate(side, changes).unwrap_or_else(|stop| panic!("{stop:?}")).table;
    let exact = reference();
    let mut worst = 0.0_f64;
    for (row, &time) in table.times.iter().enumerate() {
        let gap = |axis: &str| {
            let at = (time / 0.01).round() as usize;
            table.columns[&format!("corner_{axis}")][row] - corner(&exact, side, axis, at)
        };
        worst = worst.max(gap("x").hypot(gap("y")));
    }
    let total = &table.columns["total"];
    let drift = total.iter().map(|energy| (energy / total[0] - 1.0).abs()).fold(0.0, f64::max);
    println!("{side:>3} a side, {changes:?}: corner off by {worst:.1e} mm, energy by {drift:.1e}");
    (worst, drift)
}

fn reference() -> BTreeMap<String, Vec<f64>> {
    let (names, rows) = csv::read(&scene_folder().join("reference/sheared_plate.csv")).unwrap();
    names.into_iter().enumerate().map(|(k, name)| (name, rows.iter().map(|row| row[k]).collect())).collect()
}

/// Displacement at the centre of the corner cell. Where the reference has no column for so many a side, the parabola
/// through three such centres along the diagonal: at 11 a side good to 2e-4 mm.
fn corner(exact: &BTreeMap<String, Vec<f64>>, side: u32, axis: &str, at: usize) -> f64 {
    let place = |cells: f64| 0.5 / cells;
    let known = [(place(81.0), "uC81"), (place(41.0), "uC41"), (place(21.0), "uC21")];
    let s = place(f64::from(side));
    let one = |&(own, name): &(f64, &str)| {
        let others = known.iter().filter(|(other, _)| *other != own);
        exact[&format!("{name}_{axis}")][at] * others.map(|(other, _)| (s - other) / (own - other)).product::<f64>()
    };
    known.iter().map(one).sum()
}

#[test]
fn corrected_kernels_give_the_answer_and_keep_the_energy() {
    let (coarse, fine) = (errors(11, &[]), errors(21, &[]));
    assert!(coarse.0 < 7.5e-3 && fine.0 < 2.7e-3, "{coarse:?} {fine:?}");
    assert!(coarse.1 < 1e-4 && fine.1 < 3e-5, "{coarse:?} {fine:?}");
}

#[test]
fn leapfrog_gives_the_answer_and_keeps_the_energy() {
    let (error, drift) = errors(21, &["time.integrator=leapfrog"]);
    assert!(error < 2.7e-3 && drift < 5e-5, "{error} {drift}");
}

#[test]
fn the_reference_configuration_gives_the_answer_too() {
    let (coarse, fine) =
        (errors(11, &["formulation.configuration=reference"]), errors(21, &["formulation.configuration=reference"]));
    assert!(coarse.0 < 8e-3 && fine.0 < 2.7e-3, "{coarse:?} {fine:?}");
    assert!(coarse.1 < 1e-4 && fine.1 < 3e-5, "{coarse:?} {fine:?}");
}

/// Figure 3 of the paper.
#[test]
fn bare_kernels_let_the_energy_oscillate() {
    for side in [11, 21] {
        let (error, drift) = errors(side, &["formulation.correction=false"]);
        assert!((0.1..0.25).contains(&drift), "{side}: {drift}");
        assert!(error > 2.5e-2, "{side}: {error}");
    }
}

/// The sum of v_b alone belongs to the force and keeps the energy, but bare kernels take a moving plate's rim for a
/// sheared one.
#[test]
fn bare_kernels_and_the_velocity_gradient_as_printed_diverge_with_their_energy_kept() {
    for side in [11, 21] {
        let (error, drift) = errors(side, &["formulation.correction=false", "formulation.velocity_gradient=printed"]);
        assert!((0.5..0.8).contains(&error) && drift < 1e-3, "{side}: {error} {drift}");
    }
}

/// (8) and (5) in the current configuration do not belong together: whatever the integrator and its step, the finer
/// the lattice the sooner particles turn inside out.
#[test]
fn displacements_and_sums_in_the_current_configuration_are_unstable() {
    let mixed = "formulation.deformation=reference";
    let (_, drift) = errors(41, &[mixed]);
    assert!(drift > 1e-2, "{drift}");
    let stopped = |side, changes: &[&str]| match run_plate(side, changes) {
        Err(Stop::Failed(message)) => message,
        other => panic!("it ran to its end: {:?}", other.map(|finished| finished.table.times.len())),
    };
    let message = stopped(41, &[mixed, "duration=1.5"]);
    assert!(message.contains("volume fell to zero"), "{message}");
    let message = stopped(41, &[mixed, "formulation.correction=false"]);
    assert!(message.contains("volume fell to zero"), "{message}");
    // With F from its rate the same plate keeps its energy.
    let (error, drift) = errors(41, &[]);
    assert!(error < 7e-4 && drift < 1e-5, "{error} {drift}");
}
