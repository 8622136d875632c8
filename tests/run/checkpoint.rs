//! A run that is killed and goes on gives the same bits as one that was never broken off.

mod quasi_static;

use crate::common::adapter;
use crate::common::sandbox::{self, Said, Sandbox, signal, until};
use lithosph::output::{csv, vtkhdf};
use std::collections::BTreeMap;
use std::path::Path;

/// Long enough to be killed on the way: 80 rows, 20 frames.
const LONG: [&str; 6] = ["--set", "duration=40", "--set", "output.series=0.5", "--variant", "slow"];

/// Every dataset of a checkpoint, bit for bit.
fn checkpoint(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let file = hdf5::File::open(folder.join("checkpoint.h5")).unwrap();
    let mut all = BTreeMap::new();
    // A group of particles each.
    for place in file.member_names().unwrap().into_iter().filter(|name| name.starts_with("fields")) {
        let group = file.group(&place).unwrap();
        for name in group.member_names().unwrap() {
            let column: Vec<u8> = group.dataset(&name).unwrap().read_raw().unwrap();
            all.insert(if place == "fields" { name } else { format!("{place}.{name}") }, column);
        }
    }
    assert!(all.contains_key("displacement") && all.contains_key("velocity"), "{:?}", all.keys());
    let progress: Vec<f64> = file.dataset("progress").unwrap().read_raw().unwrap();
    all.insert("progress".into(), progress.iter().flat_map(|number| number.to_le_bytes()).collect());
    all
}

/// Everything that a run leaves and that does not tell of wall time.
#[track_caller]
fn same_output(one: &Path, other: &Path) {
    let bytes = |folder: &Path, name: &str| std::fs::read(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    for name in ["series.csv", "run.toml", "frames/00000.png", "frames/00010.png", "frames/00020.png"] {
        assert!(bytes(one, name) == bytes(other, name), "{name} differs");
    }
    let (ours, theirs) = (checkpoint(one), checkpoint(other));
    assert_eq!(ours.keys().collect::<Vec<_>>(), theirs.keys().collect::<Vec<_>>());
    for (name, column) in &ours {
        assert!(*column == theirs[name], "the checkpoint's {name} differs");
    }
    let stored = |folder: &Path| {
        let path = folder.join("particles.vtkhdf");
        let count = vtkhdf::read(&path).unwrap().len();
        (0..count).map(|k| format!("{:?}", vtkhdf::read_step(&path, k).unwrap())).collect::<Vec<_>>()
    };
    assert_eq!(stored(one), stored(other));
    let count = |folder: &Path| std::fs::read_dir(folder.join("frames")).unwrap().count();
    assert_eq!((count(one), count(other)), (21, 21));
}

fn frames(folder: &Path) -> usize {
    vtkhdf::read(&folder.join("particles.vtkhdf")).map_or(0, |times| times.len())
}

#[track_caller]
fn good(said: &Said) {
    assert_eq!(said.code, Some(0), "{said:?}");
}

/// Kills a run each time that some more frames are there, and goes on, until it comes to its end.
fn killed_and_resumed(name: &str, place: &[&str]) {
    let sandbox = Sandbox::new(name);
    good(&sandbox.lithosph(&[&["run", "s.toml", "--out", "whole"], &LONG[..], place].concat()));
    let folder = sandbox.path("parts");
    let mut arguments = [&["run", "s.toml", "--out", "parts"], &LONG[..], place].concat();
    for more in [3, 8, 14] {
        let mut child = sandbox.command(&arguments).spawn().unwrap();
        until("there are frames", || frames(&folder) >= more && folder.join("checkpoint.h5").exists());
        signal(&child, libc::SIGKILL);
        assert!(!child.wait().unwrap().success());
        // What was there is there still, each step of it whole.
        let count = frames(&folder);
        assert!(count >= more);
        for k in 0..count {
            assert_eq!(vtkhdf::read_step(&folder.join("particles.vtkhdf"), k).unwrap().positions.len(), 72);
        }
        assert!(csv::read(&folder.join("series.csv")).unwrap().1.len() > 4 * (more - 1));
        assert!(!folder.join("summary.json").exists(), "the run was over before it was killed");
        arguments = [&["run", "--resume", "parts"], place].concat();
    }
    let said = sandbox.lithosph(&arguments);
    good(&said);
    same_output(&sandbox.path("whole"), &folder);
    let summary = std::fs::read_to_string(folder.join("summary.json")).unwrap();
    assert!(summary.contains("\"scene\": \"s\"") && summary.contains("\"variant\": \"slow\""), "{summary}");
    // Once more changes nothing.
    good(&sandbox.lithosph(&arguments));
    same_output(&sandbox.path("whole"), &folder);
    assert_eq!(std::fs::read_to_string(folder.join("summary.json")).unwrap(), summary);
}

#[test]
fn a_killed_run_goes_on_to_the_same_bits_on_the_processor() {
    killed_and_resumed("resume-cpu", &["--backend", "cpu"]);
}

#[test]
fn a_killed_run_goes_on_to_the_same_bits_in_single_precision() {
    killed_and_resumed("resume-cpu32", &["--backend", "cpu", "--precision", "f32", "--threads", "1"]);
}

#[test]
fn a_killed_run_goes_on_to_the_same_bits_on_a_graphics_adapter() {
    if adapter().is_some() {
        killed_and_resumed("resume-gpu", &["--backend", "gpu"]);
    }
}

/// Broken off by an interrupt after some frames.
fn interrupted(sandbox: &Sandbox, scene: &str) {
    let mut child =
        sandbox.command(&["run", scene, "--backend", "cpu", "--out", "parts", "--set", "duration=4000"]).spawn().unwrap();
    until("there are frames", || frames(&sandbox.path("parts")) >= 3 && sandbox.exists("parts/checkpoint.h5"));
    signal(&child, libc::SIGINT);
    assert_eq!(child.wait().unwrap().code(), Some(130));
}

#[test]
fn another_backend_or_scene_is_refused() {
    let sandbox = Sandbox::new("resume-elsewhere");
    interrupted(&sandbox, "s.toml");
    let series = std::fs::read(sandbox.path("parts/series.csv")).unwrap();
    let refused = |arguments: &[&str], words: &str| {
        let said = sandbox.lithosph(&[&["run", "--resume", "parts"], arguments].concat());
        assert_eq!((said.code, said.err.lines().count()), (Some(2), 1), "{said:?}");
        assert!(said.err.contains(words), "{said:?}");
        assert!(std::fs::read(sandbox.path("parts/series.csv")).unwrap() == series, "rows were lost");
    };
    refused(&["--backend", "cpu", "--precision", "f32"], "choose the same backend");
    if adapter().is_some() {
        refused(&["--backend", "gpu"], "choose the same backend");
    }
    let resolved = std::fs::read_to_string(sandbox.path("parts/run.toml")).unwrap();
    sandbox.write("parts/run.toml", &resolved.replace("alpha = 1", "alpha = 2"));
    refused(&["--backend", "cpu"], "another scene");
    sandbox.write("parts/run.toml", &resolved);
    let usage = sandbox.lithosph(&["run", "s.toml", "--resume", "parts"]);
    assert_eq!(usage.code, Some(2), "{usage:?}");
}

/// What is expected of variants must not stand in the way: a stored scene has none left.
#[test]
fn a_scene_with_expectations_of_variants_goes_on() {
    let sandbox = Sandbox::new("resume-expecting");
    let expect = "\n[expect.kinetic]\nvalue = 1\ntolerance = 1\nsource = \"x\"\nvariant = \"slow\"\n";
    sandbox.write("expecting.toml", &format!("{}{expect}", sandbox::SCENE));
    interrupted(&sandbox, "expecting.toml");
    let child = sandbox.command(&["run", "--resume", "parts", "--backend", "cpu"]).spawn().unwrap();
    let before = frames(&sandbox.path("parts"));
    until("there are more frames", || frames(&sandbox.path("parts")) > before + 2);
    signal(&child, libc::SIGINT);
    let said = sandbox::said(child);
    assert_eq!(said.code, Some(130), "{said:?}");
}

/// A block is drawn along another, which lies on a plane: both rub, and what the springs of friction hold goes on.
const RUBBING: &str = r#"title = "Two blocks rub"
dimension = 2
units = "dimensionless"
spacing = 1
duration = 240

[[body]]
name = "lower"
shape = { block = { min = [0, 0], max = [12, 5] } }
anchor = [0.5, 0.5]
material = "rubber"
velocity = [0.01, 0]

[[body]]
name = "upper"
shape = { block = { min = [3, 5], max = [9, 9] } }
anchor = [3.5, 5.5]
material = "rubber"

[material.rubber]
law = "neo_hookean"
density = 1
youngs_modulus = 1
poisson_ratio = 0.3

[[boundary]]
name = "upper"
select = { body = "upper" }
velocity = [0.02, "free"]
force = [0, -0.06]

[[contact]]
between = ["lower", "upper"]
gap = { friction = 0.2 }

[[obstacle]]
name = "floor"
shape = { plane = { point = [0, 0], normal = [0, 1] } }
friction = 0.3

[formulation]
kind = "total_lagrangian"

[output]
series = 1
frames = 1
picture = { field = "pressure", width = 320, height = 240 }

[observe]
total = { kind = "total_energy" }
drag = { kind = "obstacle_force", obstacle = "floor", axis = "x" }
"#;

/// Kills a run of a scene after some frames and lets it go on; gives the checkpoint, which is that of an unbroken run.
fn killed_once(name: &str, scene: &str, place: &[&str]) -> BTreeMap<String, Vec<u8>> {
    let sandbox = Sandbox::new(name);
    sandbox.write("scene.toml", scene);
    good(&sandbox.lithosph(&[&["run", "scene.toml", "--out", "whole"], place].concat()));
    let (whole, parts) = (sandbox.path("whole"), sandbox.path("parts"));
    let mut child = sandbox.command(&[&["run", "scene.toml", "--out", "parts"], place].concat()).spawn().unwrap();
    until("there are frames", || frames(&parts) >= 10 && parts.join("checkpoint.h5").exists());
    signal(&child, libc::SIGKILL);
    assert!(!child.wait().unwrap().success());
    assert!(!parts.join("summary.json").exists(), "the run was over before it was killed");
    good(&sandbox.lithosph(&[&["run", "--resume", "parts"], place].concat()));
    let (ours, theirs) = (checkpoint(&whole), checkpoint(&parts));
    assert!(ours.keys().eq(theirs.keys()));
    ours.iter().for_each(|(name, column)| assert!(*column == theirs[name], "the checkpoint's {name} differs"));
    let rows = |folder: &Path| std::fs::read(folder.join("series.csv")).unwrap();
    assert!(rows(&whole) == rows(&parts), "series.csv differs");
    ours
}

#[test]
fn friction_goes_on_with_what_its_springs_hold() {
    let kept = killed_once("resume-friction", RUBBING, &["--backend", "cpu"]);
    for name in ["facet_slip", "facet_obstacle_slip"] {
        assert!(kept[name].iter().any(|&byte| byte != 0), "nothing rubs: {name}");
    }
}

/// Two discs, each of a formulation of its own, in touch when the run is killed.
fn groups_go_on(name: &str, place: &[&str]) {
    let scene = include_str!("../../scenes/mixed_discs.toml").replace("frames = 10", "frames = 2");
    let kept = killed_once(name, &scene, place);
    assert!(kept.contains_key("volumetric_strain") && kept.contains_key("fields_1.displacement_gradient"), "{:?}", kept.keys());
}

#[test]
fn groups_go_on_to_the_same_bits_on_the_processor() {
    groups_go_on("resume-groups-cpu", &["--backend", "cpu"]);
}

#[test]
fn groups_go_on_to_the_same_bits_on_a_graphics_adapter() {
    if adapter().is_some() {
        groups_go_on("resume-groups-gpu", &["--backend", "gpu"]);
    }
}

#[test]
fn a_run_without_frames_goes_on_from_its_last_row() {
    let sandbox = Sandbox::new("no_frames");
    sandbox.write("s.toml", sandbox::SCENE);
    let arguments = [&["run", "s.toml", "--backend", "cpu", "--set", "output.frames=0"][..], &LONG].concat();
    good(&sandbox.lithosph(&[&arguments[..], &["--out", "whole"]].concat()));
    let mut child = sandbox.command(&[&arguments[..], &["--out", "parts"]].concat()).spawn().unwrap();
    until("there is a checkpoint", || sandbox.exists("parts/checkpoint.h5"));
    signal(&child, libc::SIGKILL);
    child.wait().unwrap();
    good(&sandbox.lithosph(&["run", "--resume", "parts", "--backend", "cpu"]));
    assert!(checkpoint(&sandbox.path("whole")) == checkpoint(&sandbox.path("parts")));
    let series = |run: &str| std::fs::read(sandbox.path(run).join("series.csv")).unwrap();
    assert!(series("whole") == series("parts"));
}
