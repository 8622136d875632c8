//! Equilibrium at load steps: exact homogeneous stress, both ways of descent, loads, what is refused.

use crate::common::adapter;
use crate::common::patches::{HANGING, STRAIN, exact_force, patch};
use lithosph::backend::Choice;
use lithosph::run::{Finished, Options, Stop, run};
use lithosph::scene::Scene;

fn try_run(text: &str, choice: Choice, changes: &[&str]) -> Result<Finished, Stop> {
    let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
    let scene = Scene::parse(text, "test", None, &changes).unwrap_or_else(|error| panic!("{error}\n{text}"));
    run(&scene, &Options { choice, dry: true, quiet: true, ..Options::default() })
}

fn finished(text: &str, choice: Choice, changes: &[&str]) -> Finished {
    try_run(text, choice, changes).unwrap_or_else(|stop| panic!("{stop:?}"))
}

/// Largest error of the force on the grips over all load steps, over the last force.
fn patch_error(dimension: usize, run: &Finished) -> f64 {
    let forces = &run.table.columns["force"];
    assert_eq!((forces.len(), forces[0]), (5, 0.0));
    let error = |k: usize| (forces[k] + exact_force(dimension, 0.25 * k as f64 * STRAIN)).abs();
    (1..5).map(error).fold(0.0, f64::max) / exact_force(dimension, STRAIN)
}

#[test]
fn a_patch_has_the_exact_stress_and_both_descents_find_it() {
    for dimension in [1, 2] {
        for method in ["fire", "kinetic_damping"] {
            let change = format!("quasi_static.method='{method}'");
            let run = finished(&patch(dimension), Choice::Cpu, &["quasi_static.residual=1e-9", &change]);
            let error = patch_error(dimension, &run);
            let summary = &run.summary;
            println!("{dimension}D, {method}: {} force evaluations, error {error:.1e}", summary.force_evaluations);
            assert!(error < 1e-7, "{dimension}D, {method}: {error}");
            // One at the beginning of each load step, and one each step of the descent.
            assert_eq!(summary.force_evaluations, u64::from(summary.steps) + 4);
            assert!(summary.steps < 4000, "{method} took {} steps", summary.steps);
        }
    }
}

#[test]
fn single_precision_and_the_gpu_find_the_exact_stress_of_a_patch() {
    let gpu = adapter().map(|_| Choice::Gpu(None));
    for choice in [Some(Choice::Cpu32), gpu].into_iter().flatten() {
        for method in ["fire", "kinetic_damping"] {
            let run = finished(&patch(2), choice.clone(), &[&format!("quasi_static.method='{method}'")]);
            let error = patch_error(2, &run);
            println!("{choice:?}, {method}: {} steps, error {error:.1e}", run.summary.steps);
            assert!(error < 1e-4, "{choice:?}, {method}: {error}");
        }
    }
}

/// Perfectly plastic in uniaxial strain: q = sY from where it yields. The descent swings to and fro on its way, but
/// plastic flow goes from equilibrium to equilibrium, so k is that of the path: 2/3 ln(stretch) less its elastic part.
#[test]
fn plastic_flow_does_not_follow_the_swings_of_the_descent() {
    let (yield_stress, shear_modulus) = (0.01, 1.0 / 2.6);
    // q = mu (b - b^(-1/2)), 1 the unit of E.
    let mut b: f64 = 1.0;
    (0..50).for_each(|_| b = yield_stress / shear_modulus + b.powf(-0.5));
    let k = 2.0 / 3.0 * STRAIN.ln_1p() - 0.5 * b.ln();
    // P = (q 2/3 + K/10 (J^5 - J^-5))/J of the stretch J, as no side moves.
    let stretch = 1.0 + STRAIN;
    let force = 2.0 / 3.0 * yield_stress / stretch + (stretch.powi(5) - stretch.powi(-5)) / 12.0 / stretch;
    let law = ["material.rubber.law='j2'", "material.rubber.yield_stress=0.01", "quasi_static.residual=1e-9"];
    let inside = "inside = { block = { min = [6], max = [14] } }";
    for method in ["fire", "kinetic_damping"] {
        for steps in [1, 4] {
            let load = [format!("quasi_static.method='{method}'"), format!("quasi_static.load_steps={steps}")];
            let seen = format!("observe.k={{ kind = 'largest', field = 'equivalent_plastic_strain', {inside} }}");
            let changes = [&law[..], &[&load[0], &load[1], &seen]].concat();
            let run = finished(&patch(1), Choice::Cpu, &changes);
            let last = |name: &str| *run.table.columns[name].last().unwrap();
            let errors = [last("k") / k - 1.0, -last("force") / force - 1.0];
            println!("{method}, {steps} load steps: k off by {:.1e}, force by {:.1e}", errors[0], errors[1]);
            // Second order in the load step.
            let tolerance = if steps == 1 { 2e-3 } else { 2e-4 };
            assert!(errors[0].abs() < tolerance && errors[1].abs() < 1e-6, "{method}, {steps}: {errors:?}");
        }
    }
}

/// A bar hangs from its upper end: the grip carries its weight and the force on its end, each as far as it is there.
#[test]
fn loads_grow_with_the_duration_or_by_their_course() {
    let forces = |changes: &[&str]| {
        let run = finished(HANGING, Choice::Cpu, &[&["quasi_static.residual=1e-8"], changes].concat());
        run.table.columns["force"].clone()
    };
    // The free 17 of 20 particles weigh 1.7e-3, the last two of them are pulled by 3e-3.
    for (k, force) in forces(&[]).into_iter().enumerate() {
        let wanted = 4.7e-3 * k as f64 / 4.0;
        assert!((force - wanted).abs() < 1e-7, "load step {k}: {force}, not {wanted}");
    }
    let course = "boundary.1.course=[[0.0, 0.0], [0.5, 1.0], [1.0, 0.0]]";
    let seen = forces(&["body_force=[0.0]", course]);
    for (force, part) in seen.into_iter().zip([0.0, 0.5, 1.0, 0.5, 0.0]) {
        assert!((force - 3e-3 * part).abs() < 1e-7, "{force} at {part} of the force");
    }
}

#[test]
fn what_is_held_moves_by_the_integral_of_its_velocity() {
    let course = "boundary.1.course=[[0.1, 0.0], [0.3, 2.0], [0.8, -1.0]]";
    let velocity = ["boundary.1.force='none'", "boundary.1.velocity=[0.5]", "body_force=[0.0]", course];
    let run = finished(HANGING, Choice::Cpu, &velocity);
    let moved: Vec<f64> = run.table.columns["end"].iter().map(|end| end - 19.0).collect();
    // 0.5 times the integral up to 0.25, 0.5, 0.75 and 1.
    let exact = [0.0, 0.05625, 0.24, 0.24625, 0.125];
    for (moved, exact) in moved.iter().zip(exact) {
        assert!((moved - exact).abs() < 1e-12, "{moved}, not {exact}");
    }
}

fn refusal(changes: &[&str]) -> String {
    let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
    Scene::parse(&patch(2), "test", None, &changes).map(|_| ()).unwrap_err()
}

#[test]
fn what_does_not_go_with_equilibrium_is_refused() {
    let metal = "material.rubber={ law = 'j2', density = 1, youngs_modulus = 1, poisson_ratio = 0.3, yield_stress = 0.1 }";
    let cases: [(&[&str], &str); 10] = [
        (&["formulation.kind='eulerian'", "material.rubber.law='elastic'"], "formulation.kind must be `total_lagrangian`"),
        (&["formulation.viscosity={ alpha = 1.0 }"], "viscosity does nothing in equilibrium"),
        (&["material.rubber.law='maxwell'", "material.rubber.viscosity=1.0"], "creeps for ever"),
        (&[metal, "formulation.dissipated_energy=true"], "adds up plastic work step by step in time"),
        (&["time.integrator='pefrl'"], "takes no time.integrator"),
        (&["time.integrator='rk4'"], "takes no time.integrator"),
        (&["time.step=0.1"], "takes no time.step"),
        (&["quasi_static.residual=1e-14"], "residual must lie between"),
        (&["quasi_static.load_steps=0"], "load_steps must be"),
        (&["output.series=0.1"], "output.series does not go with it"),
    ];
    for (changes, words) in cases {
        let said = refusal(changes);
        assert!(said.contains(words) && said.lines().count() == 1, "{changes:?}: {said}");
    }
}

#[test]
fn a_search_without_end_stops_with_a_sentence() {
    match try_run(&patch(2), Choice::Cpu, &["quasi_static.most_steps=20"]) {
        Err(Stop::Failed(said)) => {
            assert!(said.contains("no equilibrium within the 20 steps") && said.contains("asks for 1.0e-5"), "{said}");
        }
        other => panic!("{:?}", other.map(|run| run.summary)),
    }
    match try_run(&patch(2), Choice::Cpu32, &["quasi_static.residual=1e-7"]) {
        Err(Stop::Refused(said)) => assert!(said.contains("f32 does not reach below 1e-5"), "{said}"),
        other => panic!("{:?}", other.map(|run| run.summary)),
    }
}

/// The grip holds all of the weight below it and the force at the end: what it misses in a slack descent is the imbalance that
/// the run tells of.
#[test]
fn forces_that_do_not_balance_are_told_and_warned_of() {
    let (below, largest) = (17.0 * 1e-4 + 3e-3, 20.0 * 1e-4 + 3e-3);
    for (residual, right) in [("3e-2", false), ("1e-9", true)] {
        let changes = [&format!("quasi_static.residual={residual}"), "quasi_static.load_steps=1"];
        let run = finished(HANGING, Choice::Cpu, &changes);
        let (said, force) = (&run.summary.said, run.table.columns["force"][1]);
        let balance = said.balance.clone().expect("equilibrium is sought");
        let missed = (below - force).abs() / largest;
        println!("{residual}: the grip misses {missed:.2e}; {}", balance.text);
        assert!((balance.worst.share() - missed).abs() < 1e-3 * missed + 1e-9, "{missed} and {:?}", balance.worst);
        assert_eq!(missed < 1e-4, right);
        let warned =
            said.warnings.iter().any(|w| w.contains("out of balance") && w.contains("lower quasi_static.residual from 3e-2"));
        assert!(warned != right && run.summary.text().contains(&balance.text), "{:?}", said.warnings);
    }
}
