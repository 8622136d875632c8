//! What a scene is refused or warned for, from outside: the right word for each slip that engineers made.

use crate::common::sandbox::{Said, Sandbox};

/// A bar that is held at its left end and pulled at its right.
const BAR: &str = r#"title = "bar"
dimension = 2
units = "SI"
spacing = 0.01
duration = 2e-4
[[body]]
name = "bar"
shape = { block = { min = [0, 0], max = [0.3, 0.1] } }
anchor = [0.005, 0.005]
material = "rubber"
[material.rubber]
law = "neo_hookean"
density = 1000.0
youngs_modulus = 1e6
poisson_ratio = 0.3
[formulation]
kind = "total_lagrangian"
[[boundary]]
name = "wall"
select = { inside = { block = { min = [-1, -1], max = [0.02, 1] } } }
fixed = true
[[boundary]]
name = "end"
select = { inside = { block = { min = [0.28, -1], max = [1, 1] } } }
force = [0, -50]
[output]
frames = 0
[observe]
tip = { kind = "point_displacement", at = [0.3, 0.05], axis = "y" }
"#;

/// The scene with one text in the place of another.
fn with(from: &str, to: &str) -> String {
    assert!(BAR.contains(from), "{from}");
    BAR.replacen(from, to, 1)
}

fn run(text: &str) -> (Sandbox, Said) {
    let sandbox = Sandbox::new("scene");
    sandbox.write("s.toml", text);
    let said = sandbox.lithosph(&["run", "s.toml", "--backend", "cpu", "--out", "out"]);
    (sandbox, said)
}

/// Bad input: code 2, one line that holds all words, nothing written.
#[track_caller]
fn refused(text: &str, words: &[&str]) {
    let (sandbox, said) = run(text);
    assert_eq!((said.code, said.err.lines().count()), (Some(2), 1), "{said:?}");
    assert!(words.iter().all(|word| said.err.contains(word)), "{words:?}: {}", said.err);
    assert!(!sandbox.exists("out"), "an output folder was made");
}

/// The warnings of a run that comes to its end, which are those of its summary.
#[track_caller]
fn warnings(text: &str) -> Vec<String> {
    let (sandbox, said) = run(text);
    assert_eq!(said.code, Some(0), "{said:?}");
    let list = said.err.lines().map(|line| line.strip_prefix("lithosph: warning: ").unwrap_or(line).to_string()).collect();
    let summary = std::fs::read_to_string(sandbox.path("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["warnings"], serde_json::json!(list));
    list
}

#[test]
fn a_sound_scene_says_nothing() {
    assert_eq!(warnings(BAR), Vec::<String>::new());
}

#[test]
fn a_point_outside_all_bodies_is_refused_with_its_distance() {
    let nearest = "of body `bar` at [0.295, 0.095]";
    refused(&with("[0.3, 0.05]", "[3, 3]"), &["s.toml:29: observable `tip` sits at [3, 3], 3.96939 away", nearest]);
    let probe = "kind = \"probe\", field = \"velocity.x\"";
    refused(
        &with("kind = \"point_displacement\"", probe).replace("[0.3, 0.05]", "[0.3, 0.2]"),
        &["`tip` sits at [0.3, 0.2], 0.10511"],
    );
    let kicked = with("[output]", "[[kick]]\nat = [1, 1]\nvelocity = [1, 0]\n[output]");
    refused(&kicked, &["s.toml:27: the kick sits at [1, 1], 1.14", nearest]);
    // A corner of the shape is as far as a point of the body can be from the particles.
    assert_eq!(warnings(&with("[0.3, 0.05]", "[0.3, 0.1]")), Vec::<String>::new());
}

#[test]
fn a_point_is_one_of_the_body_that_it_names() {
    let two = with(
        "[material.rubber]",
        "[[body]]\nname = \"far\"\nshape = { block = { min = [1, 0], max = [1.1, 0.1] } }\nmaterial = \"rubber\"\n[material.rubber]",
    );
    refused(&two.replace("axis = \"y\"", "axis = \"y\", body = \"far\""), &["`tip` sits at [0.3, 0.05]", "of body `far`"]);
}

#[test]
fn a_course_that_the_run_does_not_follow_is_told() {
    let course = |text: &str| with("force = [0, -50]", &format!("force = [0, -50]\ncourse = {text}"));
    let said = warnings(&course("[[0, 0], [0.2, 1]]"));
    assert!(said.len() == 1 && said[0].starts_with("s.toml:26: the course of `end` ends at 0.2"), "{said:?}");
    assert!(said[0].contains("the run reaches 0.100 %") && said[0].contains("times are in s"), "{said:?}");
    let late = warnings(&course("[[1, 0], [2, 1]]"));
    assert!(late.len() == 1 && late[0].contains("begins at 1"), "{late:?}");
    assert_eq!(warnings(&course("[[0, 0], [1e-4, 1], [5, 1]]")), Vec::<String>::new());
}

#[test]
fn a_quiet_run_still_warns() {
    let sandbox = Sandbox::new("quiet");
    sandbox.write("s.toml", &with("force = [0, -50]", "force = [0, -50]\ncourse = [[0, 0], [0.2, 1]]"));
    let said = sandbox.lithosph(&["run", "s.toml", "--backend", "cpu", "--out", "out", "--quiet"]);
    assert_eq!((said.code, said.err.lines().count()), (Some(0), 1), "{said:?}");
}

#[test]
fn a_force_on_what_is_fixed_is_refused() {
    let fixed = |text: &str| with("force = [0, -50]", &format!("force = [0, -50]\n{text}"));
    refused(&fixed("fixed = true"), &["s.toml:22: `end` has a force along y", "cannot act on what is fixed"]);
    refused(&fixed("fixed = [false, true]"), &["`end` has a force along y", "cannot act on what is fixed"]);
    refused(&fixed("velocity = [\"free\", 1]"), &["`end` has a force along y"]);
    assert_eq!(warnings(&fixed("fixed = [true, false]")), Vec::<String>::new());
}

#[test]
fn an_empty_selection_names_the_nearest_particle() {
    let wall = "max = [0.02, 1]";
    refused(&with(wall, "max = [0.005, 1]"), &["s.toml:18: `wall` selects no particle", "[0.005, 0.005]", "on the surface"]);
    refused(&with(wall, "max = [-0.5, 1]"), &["`wall` selects no particle", "of body `bar` at [0.005, ", "lies 0.505 outside"]);
    let force = "[observe]\nload = { kind = \"force\", axis = \"y\", inside = { block = { min = [0.4, 0], max = [0.5, 0.1] } } }";
    refused(&with("[observe]", force), &["observable `load` selects no particle", "lies 0.105 outside the shape"]);
}

#[test]
fn a_shape_typed_as_a_list_names_its_keys() {
    let shape = "{ block = { min = [0, 0], max = [0.3, 0.1] } }";
    let cases = [
        ("{ disc = [0, 0, 0.1] }", "`body.0.shape.disc` must be a table { center, radius }, found a list"),
        ("{ polygon = [[0, 0], [1, 0], [0, 1]] }", "`body.0.shape.polygon` must be a table { points }, found a list"),
        ("{ block = [[0, 0], [1, 1]] }", "`body.0.shape.block` must be a table { min, max }"),
        ("{ ring = 3 }", "`body.0.shape.ring` must be a table { center, inner, outer }, found 3"),
        ("{ union = [] }", "`body.0.shape.union` must be a table { of }"),
        ("{ cut = [1, 2] }", "`body.0.shape.cut` must be a table { from, remove }"),
        ("{ intersection = 'x' }", "`body.0.shape.intersection` must be a table { of }, found a string"),
        ("{ disc = { center = [0, 0], radius = 0 } }", "body `bar`: radius must be above 0 and finite, not 0"),
    ];
    for (text, words) in cases {
        refused(&with(shape, text), &["s.toml:8: ", words]);
    }
}

#[test]
fn an_observable_says_how_it_names_particles() {
    let observe = "[observe]\nload = { kind = \"force\", axis = \"y\", boundary = \"end\" }";
    refused(&with("[observe]", observe), &["s.toml:29: unknown key `boundary` in `observe.load`", "by `body`, by `inside`"]);
    let table = "[observe]\nload = { kind = \"force\", axis = \"y\", contact = \"end\" }";
    let (_, said) = run(&with("[observe]", table));
    assert!(!said.err.contains("before all tables"), "{said:?}");
}

#[test]
fn what_no_machine_holds_is_refused_before_it_is_made() {
    let cube = "{ block = { min = [0, 0, 0], max = [0.3, 0.1, 0.1] } }";
    let solid = with("{ block = { min = [0, 0], max = [0.3, 0.1] } }", cube).replace("dimension = 2", "dimension = 3");
    let fine = solid.replace("spacing = 0.01", "spacing = 1e-5");
    refused(&fine, &["s.toml:4: spacing 0.00001 makes about 3.0e12 particles of body `bar`", "GB are free", "fits"]);
    let own = solid.replace("anchor =", "spacing = 1e-5\nanchor =");
    refused(&own, &["s.toml:9: spacing 0.00001 makes about 3.0e12 particles"]);
    let copies = "copies = { count = [4294967295, 4294967295, 4294967295], apart = [1, 1, 1] }\nanchor =";
    refused(&solid.replace("anchor =", copies), &["s.toml:9: copies.count takes up to three numbers whose product is"]);
    refused(&with("frames = 0", "frames = 0\nseries = 1e-18"), &["s.toml:28: series would be written more than 1e6 times"]);
    refused(&with("frames = 0", "frames = 1e-18"), &["s.toml:27: frames would be written more than 1e6 times"]);
}

#[test]
fn an_eulerian_solid_that_is_pulled_is_told_of() {
    let eulerian = |lines: &str| {
        with("kind = \"total_lagrangian\"", &format!("kind = \"eulerian\"\n{lines}"))
            .replace("law = \"neo_hookean\"\n", "")
            .replace("kind = \"point_displacement\"", "kind = \"probe\", field = \"displacement.y\"")
    };
    let said = warnings(&eulerian(""));
    assert!(said.len() == 1 && said[0].starts_with("s.toml:15: `bar`: a solid of the Eulerian formulation"), "{said:?}");
    assert_eq!(warnings(&eulerian("artificial_stress = { epsilon = 0.3 }")), Vec::<String>::new());
    assert_eq!(warnings(&eulerian("artificial_stress = { epsilon = 0 }")), Vec::<String>::new());
}

#[test]
fn a_scene_that_finds_no_result_is_swept_by_its_series() {
    let sandbox = Sandbox::new("sweep");
    sandbox.write("s.toml", BAR);
    let sweep = |more: &[&str]| {
        let words = ["study", "sweep", "s.toml", "--vary", "boundary.end.force=[0,-50],[0,-100]", "--out"];
        sandbox.lithosph(&[&words, more].concat())
    };
    let said = sweep(&["all.csv"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    let rows: Vec<&str> = said.out.lines().collect();
    assert_eq!((rows.len(), rows[0]), (3, "boundary.end.force,tip.final,tip.min,tip.max"), "{said:?}");
    // Free flight at first: the tip moves by half the force over the mass of the end times the square of the time, and twice
    // the force moves it twice as far.
    let last = |row: &str| row.rsplit(',').nth(2).and_then(|cell| cell.parse::<f64>().ok()).unwrap_or(f64::NAN);
    assert!(last(rows[1]) < 0.0 && (last(rows[2]) / last(rows[1]) - 2.0).abs() < 1e-3, "{said:?}");
    let one = sweep(&["one.csv", "--number", "tip.drift"]);
    assert!(one.out.starts_with("boundary.end.force,tip.drift\n") && one.out.lines().count() == 3, "{one:?}");
    for (number, words) in [("tp.max", "did you mean `tip`?"), ("tip.largest", "no statistic `largest`")] {
        let said = sweep(&["none.csv", "--number", number]);
        assert!(said.code == Some(2) && said.err.contains(words) && !sandbox.exists("none.csv"), "{said:?}");
    }
}
