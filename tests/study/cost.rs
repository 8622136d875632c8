//! `lithosph study cost` from outside.

use super::accuracy::bar;

#[test]
fn a_scene_tells_the_fields_and_shaders_it_pays_for() {
    let sandbox = bar("cost");
    let said = sandbox.lithosph(&["study", "cost", "bar.toml"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    assert!(said.out.contains("Composed from its own parts alone, each scene has the same fields"), "{said:?}");
    let text = std::fs::read_to_string(sandbox.path("out/study/cost.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let cell = |name: &str| rows[1][rows[0].iter().position(|title| *title == name).unwrap()];
    assert_eq!((cell("scene"), cell("particles"), cell("own_parts_suffice")), ("bar", "20", "true"));
    assert!(cell("cpu_seconds_per_step").parse::<f64>().unwrap() > 0.0 && !cell("field_names").contains("smoothed_velocity"));
    let more = sandbox.lithosph(&["study", "cost", "bar.toml", "--set", "formulation.xsph=0.5", "--show"]);
    assert!(more.out.contains("smoothed_velocity: 1 x Particle") && more.out.contains("// smooth_velocity"), "{more:?}");
    let refused = sandbox.lithosph(&["study", "cost", "bar.toml"]);
    assert!(refused.code == Some(2) && refused.err.contains("--force overwrites it"), "{refused:?}");
    let nowhere = sandbox.lithosph(&["study", "cost", "--force"]);
    assert!(nowhere.code == Some(2) && nowhere.err.contains("name scenes"), "{nowhere:?}");
}
