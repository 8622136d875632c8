//! Bodies with no law between them, and bodies that overlap at the start.

use crate::common::sandbox::Sandbox;
use lithosph::scene::Scene;

/// Two blocks of rubber, the left flying at the right at 20 m/s; `left` is the x of the right block's left face (m).
fn blocks(left: f64, kind: &str, more: &str) -> String {
    format!(
        "title = 'two blocks'
        dimension = 2
        spacing = 0.01
        duration = 0.004
        [[body]]
        name = 'a'
        shape = {{ block = {{ min = [0, 0], max = [0.1, 0.1] }} }}
        material = 'rubber'
        velocity = [20, 0]
        [[body]]
        name = 'b'
        shape = {{ block = {{ min = [{left}, 0], max = [{}, 0.1] }} }}
        material = 'rubber'
        [material.rubber]
        {}
        density = 1000
        youngs_modulus = 1e6
        poisson_ratio = 0.3
        [formulation]
        kind = '{kind}'
        [output]
        frames = 0
        [observe]
        x = {{ kind = 'mean_position', body = 'a', axis = 'x' }}
        {more}",
        left + 0.1,
        if kind == "eulerian" { "" } else { "law = 'neo_hookean'" }
    )
}

const NONE: &str = "[[contact]]\nbetween = ['a', 'b']\nnone = true";
const GAP: &str = "[[contact]]\nbetween = ['a', 'b']\ngap = {}";
const BARRIER: &str = "[[contact]]\nbetween = ['a', 'b']\npotential = { law = 'barrier', stiffness = 1, range = 1 }";
const UNCOUPLED: &str = "[[contact]]\nbetween = ['a', 'b']\nkernel = 0";

/// The warnings in the summary of a run of this text, which are on its standard error too.
fn warned(text: &str) -> Vec<String> {
    let sandbox = Sandbox::new("strangers");
    sandbox.write("two.toml", text);
    let said = sandbox.lithosph(&["run", "two.toml", "--backend", "cpu", "--out", "out"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    let summary = std::fs::read_to_string(sandbox.path("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let lines: Vec<String> = summary["warnings"].as_array().unwrap().iter().map(|line| line.as_str().unwrap().into()).collect();
    assert!(lines.iter().all(|line| said.err.matches(line.as_str()).count() == 1), "{said:?}");
    lines
}

#[test]
fn bodies_that_meet_with_no_law_are_told_once() {
    let lines = warned(&blocks(0.12, "total_lagrangian", ""));
    assert_eq!(lines.len(), 1);
    // The blocks are 20 mm apart and come within a spacing of particles that stand 5 mm inside: after 20 mm at 20 m/s.
    for words in ["`a` and `b` come within a spacing", "t = 1.0", "s, at (0.12, 0.005)", "no law", "none = true"] {
        assert!(lines[0].contains(words), "{words}: {lines:?}");
    }
}

#[test]
fn bodies_that_share_a_face_with_no_law_are_told_at_the_start() {
    let lines = warned(&blocks(0.1, "total_lagrangian", ""));
    assert!(lines.len() == 1 && lines[0].contains("t = 0"), "{lines:?}");
}

#[test]
fn a_law_the_word_none_and_distance_are_no_reason_to_warn() {
    for (left, kind, more) in [
        (0.12, "total_lagrangian", NONE),
        (0.12, "total_lagrangian", GAP),
        (0.12, "total_lagrangian", UNCOUPLED),
        (0.12, "eulerian", ""),
        (0.12, "eulerian", NONE),
        (0.4, "total_lagrangian", ""),
    ] {
        let lines = warned(&blocks(left, kind, more));
        assert!(!lines.iter().any(|line| line.contains("no law is between")), "{kind} {more}: {lines:?}");
    }
}

#[test]
fn none_takes_the_kernel_sums_between_eulerian_bodies_away() {
    let sandbox = Sandbox::new("strangers");
    let last = |more: &str| {
        sandbox.write("two.toml", &blocks(0.11, "eulerian", more));
        let said = sandbox.lithosph(&["run", "two.toml", "--backend", "cpu", "--out", "out", "--force", "--quiet"]);
        assert_eq!(said.code, Some(0), "{said:?}");
        let series = std::fs::read_to_string(sandbox.path("out/series.csv")).unwrap();
        series.lines().last().unwrap().split(',').nth(1).unwrap().parse::<f64>().unwrap()
    };
    // Free flight takes the block 80 mm on; the other one slows it.
    assert!((last(NONE) - 0.13).abs() < 1e-6);
    assert!(last("") < 0.12);
}

#[test]
fn overlap_at_the_start_is_refused_with_place_and_depth() {
    for (kind, more) in [("total_lagrangian", ""), ("total_lagrangian", GAP), ("total_lagrangian", BARRIER), ("eulerian", "")] {
        let said = Scene::parse(&blocks(0.05, kind, more), "two.toml", None, &[]).map(|_| ()).unwrap_err();
        assert!(said.starts_with("two.toml:10: the bodies `a` and `b` overlap at the start"), "{said}");
        assert!(said.contains("lies 0.045 deep in"), "{said}");
    }
    assert!(Scene::parse(&blocks(0.05, "total_lagrangian", NONE), "two.toml", None, &[]).is_ok());
    // Faces that touch, or overlap by less than the particles lie beneath them, are no overlap.
    assert!(Scene::parse(&blocks(0.1, "total_lagrangian", GAP), "two.toml", None, &[]).is_ok());
    assert!(Scene::parse(&blocks(0.097, "total_lagrangian", GAP), "two.toml", None, &[]).is_ok());
}

#[test]
fn none_goes_with_nothing_beside_it() {
    let refused =
        |more: &str| Scene::parse(&blocks(0.12, "total_lagrangian", more), "two.toml", None, &[]).map(|_| ()).unwrap_err();
    let both = refused(&format!("{NONE}\ngap = {{}}"));
    assert!(both.contains("none = true says that nothing acts"), "{both}");
    let nothing = refused("[[contact]]\nbetween = ['a', 'b']\nnone = false");
    assert!(nothing.contains("zones, gap, tie or none"), "{nothing}");
}
