//! The speed of sound beside a material, warnings where times and speeds make no sense together, and fixed steps that no run
//! bears.

use crate::common::parse;
use crate::common::sandbox::Sandbox;
use lithosph::backend::frequency::longest_step;

/// A steel bar of 100 mm that flies, in mm, t and s.
const BAR: &str = "title = 'bar'
dimension = 2
units = 'mm-t-s'
spacing = 5.0
duration = 1e-4
[[body]]
name = 'bar'
shape = { block = { min = [0, 0], max = [100, 20] } }
material = 'steel'
velocity = [1000, 0]
[material.steel]
law = 'neo_hookean'
density = 7.85e-9
youngs_modulus = 210000
poisson_ratio = 0.3
[output]
frames = 0
";

#[track_caller]
fn with(from: &str, to: &str) -> String {
    assert!(BAR.contains(from), "{from}");
    BAR.replacen(from, to, 1)
}

#[track_caller]
fn warned(text: &str, words: &[&str]) {
    let warnings = parse(text).warnings;
    assert!(warnings.iter().any(|warning| words.iter().all(|word| warning.contains(word))), "{words:?}: {warnings:?}");
}

#[test]
fn the_speed_of_sound_has_its_unit() {
    // sqrt((K + 4/3 G)/rho) of steel.
    let lines = parse(BAR).wave_lines();
    assert_eq!(lines, ["`steel`: sound travels at 6.001e6 mm/s and through `bar`, 100 mm long, in 1.67e-5 s"]);
    let twice = with(
        "[material.steel]",
        "[[body]]\nname = 'b'\nshape = { block = { min = [200, 0], max = [210, 20] } }\nmaterial = 'steel'\n[material.steel]",
    );
    assert_eq!(parse(&twice).wave_lines().len(), 1);
    let sandbox = Sandbox::new("sound");
    let said = sandbox.lithosph(&["run", "s.toml", "--backend", "cpu", "--out", "out"]);
    assert!(said.out.contains("`rubber`: sound travels at 1.16 L/T"), "{said:?}");
}

#[test]
fn numbers_in_another_unit_are_warned_of_and_sound_ones_are_not() {
    assert_eq!(parse(BAR).warnings, Vec::<String>::new());
    // A density in kg/m^3, a modulus in Pa over a longer run, a speed typed in the unit of another scene.
    warned(&with("density = 7.85e-9", "density = 7850"), &["test:13: sound travels at 6 mm/s in `bar`", "t/mm^3 for densities"]);
    let slow = with("youngs_modulus = 210000", "youngs_modulus = 2.1e11").replace("duration = 1e-4", "duration = 1e-3");
    warned(&slow, &["test:11: sound travels at 6e9 mm/s in `bar` and crosses it 60000 times", "steps", "MPa for moduli"]);
    let wall = "[[obstacle]]\nname = 'wall'\nshape = { plane = { point = [200, 0], normal = [-1, 0] } }\n[output]";
    let impact = |speed: &str| with("[output]", wall).replace("velocity = [1000, 0]", speed);
    warned(&impact("velocity = [1e8, 0]"), &["1e8 mm/s, 17 times as fast as sound in `bar` (6e6 mm/s)", "mm/s for speeds"]);
    assert_eq!(parse(&impact("velocity = [1e7, 0]")).warnings, Vec::<String>::new());
    // A body that flies through nothing meets nothing, however fast.
    assert_eq!(parse(&with("velocity = [1000, 0]", "velocity = [1e8, 0]")).warnings, Vec::<String>::new());
}

#[test]
fn an_end_that_is_driven_faster_than_sound_is_warned_of() {
    let pulled = |course: &str| {
        let end = "[[boundary]]\nselect = { inside = { block = { min = [94, -1], max = [101, 21] } } }\nvelocity = [2000, 0]";
        with("[output]", &format!("{end}\n{course}\n[output]"))
    };
    assert_eq!(parse(&pulled("")).warnings, Vec::<String>::new());
    warned(&pulled("course = [[0, 0], [1e-5, 2e4]]"), &["as fast as sound in `bar`"]);
}

/// The standard error of a run with a fixed step, and its code.
fn stepped(step: &str, more: &[&str]) -> (Option<i32>, String) {
    let sandbox = Sandbox::new("step");
    sandbox.write("s.toml", &with("[output]", &format!("[time]\nstep = {step}\n[watch]\nenergy = 'off'\n[output]")));
    let said =
        sandbox.lithosph(&[&["run", "s.toml", "--backend", "cpu", "--out", "out", "--set", "duration=4e-6"], more].concat());
    (said.code, said.err)
}

#[test]
fn a_fixed_step_beyond_the_integrators_limit_is_warned_of() {
    let rows = ["--set", "output.series=2e-6"];
    let (longest, _) = longest_step(&parse(BAR)).unwrap();
    assert_eq!(stepped(&format!("{:e}", 0.99 * longest), &rows), (Some(0), String::new()));
    let (_, said) = stepped(&format!("{:e}", 1.01 * longest), &rows);
    assert!(
        said.starts_with("lithosph: warning: s.toml:17: the fixed time.step of ") && said.contains(" s is 1.01 times as long"),
        "{said}"
    );
    assert!(said.contains("what the integrator bears at the highest frequency"), "{said}");
    // One that no output leaves whole.
    let (code, said) = stepped("3e-7", &["--set", "output.series=1e-7"]);
    assert!(code == Some(0) && said.contains("longer than the 1e-7 s between outputs"), "{said}");
}

#[test]
fn a_step_longer_than_the_run_is_named_as_what_it_is() {
    let (code, said) = stepped("1e6", &[]);
    assert_eq!((code, said.lines().count()), (Some(2), 1), "{said}");
    assert!(
        said.contains("s.toml:17: a time.step of 1000000 is longer than the whole run, whose duration is 0.000004"),
        "{said}"
    );
}
