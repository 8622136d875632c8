//! A run that goes wrong says where, and keeps the state that it was left with.

use crate::common::adapter;
use crate::common::sandbox::Sandbox;
use lithosph::backend::Choice;
use lithosph::run::{Options, Stop, run};
use lithosph::scene::Scene;

/// One block rests. The other is squeezed so fast that the first step turns it inside out.
const SQUEEZED: &str = r#"title = "A block turned inside out"
dimension = 2
units = "mm-t-s"
spacing = 1
duration = 10

[[body]]
name = "resting"
shape = { block = { min = [0, 0], max = [6, 6] } }
anchor = [0.5, 0.5]
material = "rubber"

[[body]]
name = "squeezed"
shape = { block = { min = [20, 0], max = [26, 6] } }
anchor = [0.5, 0.5]
material = "rubber"
motion = { gradient = [[-1.2, 0], [0, 0]] }

[material.rubber]
law = "neo_hookean"
density = 1
youngs_modulus = 1e-4
poisson_ratio = 0.3

[formulation]
kind = "total_lagrangian"

[time]
step = 1

[output]
series = 1
frames = 5
picture = { field = "pressure", width = 320, height = 240 }

[observe.kinetic]
kind = "kinetic_energy"
"#;

fn stopped(text: &str, choice: &Choice, changes: &[&str]) -> String {
    let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
    let scene = Scene::parse(text, "test", None, &changes).unwrap_or_else(|error| panic!("{error}\n{text}"));
    match run(&scene, &Options { choice: choice.clone(), dry: true, quiet: true, ..Options::default() }) {
        Err(Stop::Failed(reason)) => reason,
        other => panic!("{choice:?}: {:?}", other.map(|_| "well")),
    }
}

fn choices() -> Vec<Choice> {
    let gpu = adapter().map(|_| Choice::Gpu(None));
    [Some(Choice::Cpu), Some(Choice::Cpu32), gpu].into_iter().flatten().collect()
}

#[track_caller]
fn says(reason: &str, parts: &[&str]) {
    for part in parts {
        assert!(reason.contains(part), "no `{part}` in: {reason}");
    }
}

#[test]
fn a_body_turned_inside_out_is_named_with_particle_place_time_and_remedy() {
    for choice in choices() {
        let reason = stopped(SQUEEZED, &choice, &[]);
        println!("{choice:?}: {reason}");
        let parts =
            ["t = 1.000000e0, step 1:", "body `squeezed`, particle ", " mm, one of ", "whose volume is -", "try time.step = 5"];
        says(&reason, &parts);
        assert!(!reason.contains("resting"), "{reason}");
    }
}

#[test]
fn numbers_that_are_none_are_told_by_their_names() {
    let (fast, faster) =
        ("kick=[{ at = [23.5, 3.5], velocity = [1e150, 0] }]", "kick=[{ at = [23.5, 3.5], velocity = [1e300, 0] }]");
    for choice in choices() {
        let single = choice != Choice::Cpu;
        let reason = stopped(SQUEEZED, &choice, &[fast]);
        println!("{choice:?}: {reason}");
        says(&reason, &["no longer a number: body `squeezed`, particle ", " is no number"]);
        // In f64 the number is still one, and its square is none.
        let reason = stopped(SQUEEZED, &choice, &[faster]);
        println!("{choice:?}: {reason}");
        let part = if single { " is no number" } else { "which is the fastest, at 1.00e300" };
        says(&reason, &["no longer a number: body `squeezed`, particle ", part]);
    }
}

#[test]
fn the_most_crowded_particle_of_a_full_list_is_named() {
    let changes =
        ["formulation.kind='eulerian'", "material.rubber.law='elastic'", "formulation.list_capacity=4", "time.step=0.001"];
    for choice in choices() {
        let reason = stopped(SQUEEZED, &choice, &changes);
        println!("{choice:?}: {reason}");
        says(&reason, &["more neighbours than its list can hold", "particle ", "the most neighbours, "]);
    }
}

#[test]
fn the_last_state_is_kept_to_look_at() {
    let sandbox = Sandbox::new("fault-kept");
    sandbox.write("scene.toml", SQUEEZED);
    let said = sandbox.lithosph(&["run", "scene.toml", "--backend", "cpu", "--out", "o"]);
    assert_eq!(said.code, Some(1), "{said:?}");
    says(&said.err, &["the last state is the picture frames/00001.png", "what was written so far is in o"]);
    assert!(sandbox.path("o").join("frames/00001.png").exists());
    let painted = sandbox.lithosph(&["render", "o", "--step", "1", "--out", "again"]);
    assert!(cfg!(not(feature = "hdf5")) || painted.code == Some(0), "{painted:?}");
    // The checkpoint is of before, and what is after it is dropped.
    let again = sandbox.lithosph(&["run", "--resume", "o", "--backend", "cpu"]);
    says(&again.err, &["the last state is the picture frames/00001.png"]);
}
