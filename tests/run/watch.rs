//! The watch over a run's energy: what keeps it says by how much, what makes it is warned of and stopped.

use crate::common::adapter;
use crate::common::sandbox::Sandbox;
use lithosph::backend::Choice;
use lithosph::run::{Finished, Options, Stop, run};
use lithosph::scene::Scene;

/// A block that is struck in its middle and is free. Heun's method makes energy at any step, (omega dt)^4/8 of each swing.
const STRUCK: &str = r#"title = "A struck block"
dimension = 2
units = "dimensionless"
spacing = 1
duration = 40

[[body]]
name = "block"
shape = { block = { min = [0, 0], max = [8, 8] } }
anchor = [0.5, 0.5]
material = "rubber"

[[kick]]
at = [3.5, 3.5]
velocity = [0.01, 0]

[material.rubber]
law = "neo_hookean"
density = 1
youngs_modulus = 1
poisson_ratio = 0.3

[formulation]
kind = "total_lagrangian"

[time]
step = 0.05

[output]
series = 2
frames = 20
picture = { field = "pressure", width = 320, height = 240 }

[observe.kinetic]
kind = "kinetic_energy"
"#;

/// What makes a good third more energy in ten units of time.
const RISING: [&str; 2] = ["time.integrator='rk2'", "time.step=0.5"];

fn try_run(text: &str, choice: Choice, changes: &[&str]) -> Result<Finished, Stop> {
    let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
    let scene = Scene::parse(text, "test", None, &changes).unwrap_or_else(|error| panic!("{error}\n{text}"));
    run(&scene, &Options { choice, dry: true, quiet: true, ..Options::default() })
}

fn choices() -> Vec<Choice> {
    let gpu = adapter().map(|_| Choice::Gpu(None));
    [Some(Choice::Cpu), Some(Choice::Cpu32), gpu].into_iter().flatten().collect()
}

fn drift(finished: &Finished) -> f64 {
    finished.summary.said.energy.drift().expect("the energy is watched").abs()
}

#[test]
fn what_keeps_its_energy_says_by_how_much() {
    for choice in choices() {
        let run = try_run(STRUCK, choice.clone(), &[]).unwrap();
        println!("{choice:?}: {}", run.summary.said.energy.text());
        assert!(drift(&run) < 2e-3, "{choice:?}: {}", drift(&run));
        assert!(run.summary.said.warnings.is_empty());
        assert!(run.summary.text().contains("energy: drift of"), "{}", run.summary.text());
    }
}

#[test]
fn what_makes_energy_stops_the_run() {
    for choice in choices() {
        let Err(Stop::Failed(reason)) = try_run(STRUCK, choice.clone(), &RISING) else {
            panic!("{choice:?} does not stop");
        };
        for part in
            ["the energy has grown by", "rk2 makes energy", "try time.step = 2.50e-1 in place of 5.00e-1", "--energy warn"]
        {
            assert!(reason.contains(part), "{choice:?}: {reason}");
        }
    }
}

#[test]
fn a_scene_says_where_it_stops() {
    let grown = |changes: &[&str]| try_run(STRUCK, Choice::Cpu, &[&RISING[..], changes].concat());
    let on = grown(&["watch.energy='warn'"]).unwrap();
    assert!(drift(&on) > 0.1);
    let warnings = &on.summary.said.warnings;
    assert!(warnings.len() == 1 && warnings[0].contains("the energy has grown by"), "{warnings:?}");
    let off = grown(&["watch.energy='off'"]).unwrap();
    assert!(off.summary.said.energy.drift().is_none() && off.summary.said.warnings.is_empty());
    assert!(off.summary.text().contains("energy not watched"), "{}", off.summary.text());
    assert_eq!(off.table.columns, on.table.columns, "the watch changes the run");
    // The same run passes with a limit above its drift, and stops below it.
    assert!(grown(&[&format!("watch.energy_drift={}", 1.01 * drift(&on))]).is_ok());
    assert!(matches!(grown(&[&format!("watch.energy_drift={}", 0.99 * drift(&on))]), Err(Stop::Failed(_))));
}

#[test]
fn losses_that_are_not_added_up_only_lower_the_energy() {
    let viscous = ["formulation.viscosity.alpha=0.5"];
    let lost = try_run(STRUCK, Choice::Cpu, &viscous).unwrap();
    let text = lost.summary.said.energy.text();
    assert!(drift(&lost) < 1e-3 && text.contains("viscosity"), "{text}");
    let (first, last) = (lost.summary.said.energy.json()["first"].as_f64(), lost.summary.said.energy.json()["last"].as_f64());
    assert!(last < first.map(|energy| 0.5 * energy), "the block should have lost half: {first:?} {last:?}");
    // Heat is added up to the first order of the step: 1.6 % of a blow that dies within some swings are missed at 0.1.
    let counted = ["formulation.dissipated_energy=true", "time.step=0.02"];
    let counted = try_run(STRUCK, Choice::Cpu, &[&viscous[..], &counted[..]].concat()).unwrap();
    assert!(drift(&counted) < 5e-3, "{}", counted.summary.said.energy.text());
}

/// A pull on the right side that stays the same, and a weight that pulls all down on a held bottom: both have potentials.
#[test]
fn steady_forces_have_potentials() {
    let held = "[[boundary]]\nname = 'bottom'\nselect = { inside = { block = { min = [0, 0], max = [8, 1] } } }\nfixed = true\n\
                [[boundary]]\nname = 'right'\nselect = { inside = { block = { min = [7, 1], max = [8, 8] } } }\nforce = [0.02, 0]\n";
    let text = format!("{STRUCK}[observe.total]\nkind = \"total_energy\"\n{held}");
    let run = try_run(&text, Choice::Cpu, &["body_force=[0, -0.001]"]).unwrap();
    println!("{}", run.summary.said.energy.text());
    assert!(drift(&run) < 2e-3, "{}", run.summary.said.energy.text());
    // Without the potentials, energy would come from nowhere.
    let (total, kinetic) = (&run.table.columns["total"], &run.table.columns["kinetic"]);
    let moved = kinetic.iter().copied().fold(0.0, f64::max);
    assert!(total.iter().all(|energy| (energy - total[0]).abs() < 2e-3 * moved) && moved > 10.0 * kinetic[0], "{total:?}");
}

#[test]
fn an_odd_watch_is_refused() {
    let refused = |change: &str| Scene::parse(STRUCK, "test", None, &[change.into()]).unwrap_err();
    assert!(refused("watch.energy='of'").contains("off"), "{}", refused("watch.energy='of'"));
    assert!(refused("watch.energy_drift=0").contains("energy_drift must be a positive number"));
    let both = Scene::parse(STRUCK, "test", None, &["watch.energy_drift=0.2".into(), "watch.energy='warn'".into()]).unwrap_err();
    assert!(both.contains("give one of the two"), "{both}");
}

#[test]
fn a_stopped_run_keeps_its_files_and_goes_on_where_it_is_told_to() {
    let sandbox = Sandbox::new("watch-stops");
    sandbox.write("scene.toml", &STRUCK.replace("step = 0.05", "step = 0.5\nintegrator = \"rk2\""));
    let said = sandbox.lithosph(&["run", "scene.toml", "--backend", "cpu", "--out", "o"]);
    assert!(said.code == Some(1) && said.err.contains("the energy has grown by"), "{said:?}");
    let folder = sandbox.path("o");
    assert!(folder.join("series.csv").exists() && folder.join("checkpoint.h5").exists() && !folder.join("summary.json").exists());
    let rows = || std::fs::read_to_string(folder.join("series.csv")).unwrap().lines().count();
    let before = rows();
    let again = sandbox.lithosph(&["run", "--resume", "o", "--backend", "cpu"]);
    assert_eq!(again.code, Some(1), "what a checkpoint has of the energy is lost: {again:?}");
    let on = sandbox.lithosph(&["run", "--resume", "o", "--backend", "cpu", "--energy", "warn"]);
    assert_eq!(on.code, Some(0), "{on:?}");
    assert!(rows() > before && rows() == 22, "{} rows", rows());
}
