//! Bodies that pass through each other although a law of contact is between them.

use crate::common::parse;
use lithosph::backend::Choice;
use lithosph::run::{Finished, Options, Stop, run};

/// A block strikes another a thousand times as soft, at two thirds of the speed of the waves in it.
const STRUCK: &str = r#"title = "A hard block strikes a soft one"
dimension = 2
units = "dimensionless"
spacing = 1
duration = 8
[[body]]
name = "device"
shape = { block = { min = [-4, 8.5], max = [4, 15.5] } }
material = "hard"
velocity = [0, -1.3]
[[body]]
name = "tissue"
shape = { block = { min = [-12, 0], max = [12, 8] } }
material = "soft"
[material.hard]
law = "st_venant_kirchhoff"
density = 1
youngs_modulus = 1000
poisson_ratio = 0.3
[material.soft]
law = "neo_hookean"
density = 1
youngs_modulus = 1
poisson_ratio = 0.45
[formulation]
kind = "total_lagrangian"
[[contact]]
between = ["device", "tissue"]
gap = {}
[[boundary]]
select = { inside = { block = { min = [-99, -1], max = [99, 1] } } }
fixed = true
[observe]
yd = { kind = "mean_position", body = "device", axis = "y" }
total = { kind = "total_energy" }
"#;

fn struck(gap: &str) -> Result<Finished, Stop> {
    let scene = parse(&STRUCK.replace("gap = {}", gap));
    run(&scene, &Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() })
}

#[test]
fn a_contact_that_gives_way_stops_the_run_with_its_place() {
    let Err(Stop::Failed(said)) = struck("gap = {}") else { panic!("the block passed through in silence") };
    for words in ["`device` and `tissue` pass through each other at (", "raise the stiffness of their [[contact]]"] {
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn bodies_that_are_pressed_together_do_not_count_as_crossed() {
    let finished = struck("gap = { stiffness = 20 }").unwrap_or_else(|stop| panic!("{stop:?}"));
    // Its middle, at 12 at first, would be at 1.6 had it met nothing.
    let end = finished.table.columns["yd"].last().copied().unwrap();
    assert!(end > 9.0, "the block sank to {end}");
}
