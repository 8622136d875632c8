//! Few layers between the held faces of a body that yields.

use crate::common::parse;

/// A bar of this length, whose ends of one layer are held by these conditions.
fn said(length: f64, law: &str, left: &str, right: &str) -> Vec<String> {
    let scene = parse(&format!(
        "title = 'bar'
        dimension = 2
        spacing = 1
        duration = 1
        [[body]]
        name = 'bar'
        shape = {{ block = {{ min = [0, 0], max = [{length}, 6] }} }}
        material = 'metal'
        [material.metal]
        {law}
        density = 1
        youngs_modulus = 1
        poisson_ratio = 0.3
        [formulation]
        kind = 'total_lagrangian'
        [[boundary]]
        name = 'left'
        select = {{ inside = {{ block = {{ min = [0, 0], max = [1, 6] }} }} }}
        {left}
        [[boundary]]
        name = 'right'
        select = {{ inside = {{ block = {{ min = [{}, 0], max = [{length}, 6] }} }} }}
        {right}",
        length - 1.0
    ));
    scene.warnings
}

const YIELDS: &str = "law = 'j2'\nyield_stress = 0.01";
const PULLED: &str = "velocity = [0.01, 'free']";

#[test]
fn a_short_bar_that_yields_between_held_ends_is_warned_of() {
    let lines = said(8.0, YIELDS, "fixed = true", PULLED);
    assert_eq!(lines.len(), 1);
    for words in ["only 6 layers of `bar`", "`left` and `right`", "1.5 times too strong", "a spacing of 0.333 or less"] {
        assert!(lines[0].contains(words), "{words}: {lines:?}");
    }
}

#[test]
fn longer_elastic_and_free_bars_are_not() {
    let none = [""; 0];
    assert_eq!(said(22.0, YIELDS, "fixed = true", PULLED), none);
    assert_eq!(said(8.0, "law = 'neo_hookean'", "fixed = true", PULLED), none);
    assert_eq!(said(8.0, YIELDS, "fixed = true", "force = [0.01, 0]"), none);
    // Rollers: the right end is free along the bar.
    assert_eq!(said(8.0, YIELDS, "fixed = true", "fixed = [false, true]"), none);
    // Every layer is prescribed: nothing lies between.
    assert_eq!(said(2.0, YIELDS, "fixed = true", PULLED).iter().filter(|line| line.contains("held")).count(), 0);
}
