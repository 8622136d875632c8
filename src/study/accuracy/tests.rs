use super::front::{Expected, best, front, worst};
use super::matrix::{Axis, Matrix, Value};
use super::row::{COST, OK, RUN, Row, columns};
use super::table::{Header, Table, cells, line};
use crate::scene::{Scene, read};
use std::collections::HashSet;

const SCENE: &str = r#"title = "A bar"
dimension = 1
units = "dimensionless"
spacing = 0.1
duration = 1

[[body]]
name = "bar"
shape = { block = { min = [0], max = [1] } }
material = "rubber"

[material.rubber]
density = 1
youngs_modulus = 1
poisson_ratio = 0.3
"#;

fn matrix(vary: &[&str], more: &str) -> Result<Matrix, String> {
    let (text, vary) = (format!("{SCENE}{more}"), vary.iter().map(|text| (*text).to_string()).collect::<Vec<_>>());
    let read = read::read_text(&text, "s.toml", None, &[])?;
    Matrix::new(&vary, &read, |overrides| Scene::parse(&text, "s.toml", None, overrides))
}

fn shown(axis: &str) -> Vec<String> {
    Axis::parse(axis).unwrap().values.into_iter().map(|value| value.shown).collect()
}

fn refused(vary: &[&str], more: &str) -> String {
    matrix(vary, more).map(|matrix| panic!("{matrix:?}")).unwrap_err()
}

#[test]
fn an_axis_is_a_path_and_values() {
    assert_eq!(shown("time.cfl= 0.20, 4e-1"), ["0.2", "0.4"]);
    assert_eq!(shown("time.integrator=leapfrog,\"rk4\""), ["leapfrog", "rk4"]);
    assert_eq!(
        shown("x=[1,2],{ a = 1, b = [2] },'p,q',\"r\\\",s\",none"),
        ["[1, 2]", "{ a = 1, b = [2] }", "p,q", "r\",s", "none"]
    );
    let fail = |text: &str| Axis::parse(text).unwrap_err();
    assert_eq!(fail("cfl"), "--vary cfl: must be `path=value,value`, found no `=`");
    assert_eq!(fail("cfl=1,,2"), "--vary cfl: has an empty value");
    assert_eq!(fail("cfl=0.2,0.20"), "--vary cfl: the value 0.2 comes twice");
}

#[test]
fn a_matrix_is_the_product_of_its_axes() {
    let matrix = matrix(&["time.cfl=0.2,0.4", "time.integrator=leapfrog,rk4,ssp_rk3"], "").unwrap();
    assert_eq!(matrix.paths, ["time.cfl", "time.integrator"]);
    let shown: Vec<String> = matrix.settings.iter().map(|setting| setting.shown.join(" ")).collect();
    assert_eq!(shown, ["0.2 leapfrog", "0.2 rk4", "0.2 ssp_rk3", "0.4 leapfrog", "0.4 rk4", "0.4 ssp_rk3"]);
    assert_eq!(matrix.settings[3].overrides, ["time.cfl=0.4", "time.integrator=leapfrog"]);
    assert_eq!(matrix.left_out, None);
}

#[test]
fn a_scene_brings_its_own_matrix() {
    let own = "[study.accuracy]\n\"time.cfl\" = [0.3, 0.1]\n\"time.integrator\" = [\"rk2\"]\n";
    let settings = |vary: &[&str]| matrix(vary, own).unwrap().settings.into_iter().map(|s| s.shown.join(" ")).collect::<Vec<_>>();
    assert_eq!(settings(&[]), ["0.3 rk2", "0.1 rk2"]);
    assert_eq!(settings(&["spacing=0.1"]), ["0.1"]);
    let line = 1 + SCENE.lines().count() + 1;
    let bad = |entry: &str| refused(&[], &format!("[study.accuracy]\n{entry}\n"));
    assert_eq!(bad("\"time.cfll\" = [1]"), format!("s.toml:{line}: `time.cfll`: unknown key `cfll`, did you mean `cfl`?"));
    assert_eq!(bad("\"time.cfl\" = []"), format!("s.toml:{line}: `time.cfl`: has no value"));
    let list = "a list of values under a path in quotes such as `\"time.cfl\" = [0.2, 0.4]`";
    assert_eq!(bad("time.cfl = [1]"), format!("s.toml:{line}: `study.accuracy.time` must be {list}, found a table"));
    assert_eq!(bad("\"time.cfl\" = 1"), format!("s.toml:{line}: `study.accuracy.time.cfl` must be {list}, found 1"));
    assert!(refused(&[], "[study.acuracy]\n").contains("did you mean `accuracy`?"));
    assert!(refused(&[], "[[study]]\naccuracy = { \"time.cfl\" = 1 }\n").contains("`study` must be a table, found a list"));
}

#[test]
fn a_combination_that_is_no_scene_is_told_with_its_axis() {
    assert_eq!(refused(&["tiem.cfl=1"], ""), "--vary tiem.cfl: unknown key `tiem`, did you mean `time`?");
    assert_eq!(refused(&["time.cfl=0.2,-1"], ""), "--vary time.cfl: cfl must be a positive number, found -1");
    assert_eq!(refused(&["time.cfl=0.2", "time.cfl=0.4"], ""), "--vary time.cfl: is given twice");
    assert!(refused(&["variant=a,b"], "").starts_with("--vary variant: variants are chosen"));
    let thousand = (0..200).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
    assert!(refused(&[&format!("a={thousand}"), &format!("b={thousand}")], "").contains("more than 10000 settings"));
}

#[test]
fn the_usual_matrix_leaves_out_what_means_nothing() {
    let usual = |text: &str, from: &str, to: &str| {
        let text = text.replace(from, to);
        let read = read::read_text(&text, "s.toml", None, &[]).unwrap();
        Matrix::new(&[], &read, |overrides| Scene::parse(&text, "s.toml", None, overrides)).unwrap()
    };
    let all = usual(SCENE, "", "");
    assert_eq!(all.paths, ["spacing", "formulation.smoothing_length", "time.integrator", "time.cfl"]);
    assert_eq!((all.settings.len(), all.left_out), (24, None));
    let anchored = usual(SCENE, "material = \"rubber\"", "material = \"rubber\"\nanchor = [0.05]");
    assert_eq!(anchored.paths[0], "formulation.smoothing_length");
    let fixed = usual(SCENE, "[material", "[time]\nstep = 0.01\n[material");
    assert_eq!(fixed.paths.last().unwrap(), "time.integrator");
    // A refused combination is left out, and only it.
    let read = read::read_text(SCENE, "s.toml", None, &[]).unwrap();
    let open = |overrides: &[String]| match overrides.iter().any(|text| text.ends_with("=ssp_rk3")) {
        true => Err("no such stages".to_string()),
        false => Scene::parse(SCENE, "s.toml", None, overrides),
    };
    let fewer = Matrix::new(&[], &read, open).unwrap();
    assert_eq!((fewer.settings.len(), fewer.left_out), (12, Some((12, "no such stages".into()))));
}

fn row(values: &[&str], repeat: u32, seconds: f64, errors: &[f64]) -> Row {
    let key = values.iter().copied().chain(["cpu", "f64"]).map(String::from).chain([repeat.to_string()]).collect();
    let mut cost = [1.0; COST.len()];
    cost[4] = seconds;
    Row { key, cost: Some(cost), errors: errors.iter().map(|&error| Some(error)).collect(), status: OK.into() }
}

#[test]
fn rows_come_back_from_their_cells() {
    let full = row(&["[1, 2]", "a \"b\""], 1, 1.0 / 3.0, &[1e-17]);
    let failed = Row { cost: None, errors: vec![None], status: "failed: a, b".into(), ..full.clone() };
    for row in [full, failed] {
        let text = line(&row.cells());
        assert_eq!(Row::from_cells(cells(&text), 2 + RUN.len() + COST.len() + 2, 1), Ok(row));
    }
    let names = columns(&["time.cfl".into()], ["front"].into_iter());
    assert_eq!(
        names.join(","),
        "time.cfl,backend,precision,repeat,particles,steps,force_evaluations,particle_updates,cpu_seconds,wall_seconds,bytes,bytes_per_particle,error_front,status"
    );
    assert!(Row::from_cells(vec!["1".into()], 2, 0).unwrap_err().contains("1 values for 2 columns"));
}

fn header(stamp: &str) -> Header {
    Header { stamp: stamp.into(), columns: columns(&["h".into()], ["front"].into_iter()), errors: 1 }
}

#[test]
fn a_table_goes_on_where_a_kill_left_it() {
    let path = std::env::temp_dir().join(format!("lithosph-study-{}.csv", std::process::id()));
    let rows = [row(&["1.2"], 1, 1.0, &[0.5]), row(&["1.3"], 1, 2.0, &[0.25])];
    let wanted: HashSet<_> = rows.iter().map(|row| row.key.clone()).collect();
    let open =
        |stamp: &str, wanted: &HashSet<_>, force| Table::open(&path, &header(stamp), &|row| wanted.contains(&row.key), force);
    let mut table = open("one", &wanted, true).unwrap();
    for row in &rows {
        table.append(row.clone()).unwrap();
    }
    let whole = std::fs::read_to_string(&path).unwrap();
    for length in 0..=whole.len() {
        std::fs::write(&path, &whole[..length]).unwrap();
        let mut table = open("one", &wanted, false).unwrap_or_else(|error| panic!("{length}: {error}"));
        for row in rows.iter().skip(table.rows.len()) {
            assert!(!table.holds(&row.key));
            table.append(row.clone()).unwrap();
        }
        assert_eq!(std::fs::read_to_string(&path).unwrap(), whole, "cut after {length} bytes");
    }
    assert!(open("two", &wanted, false).unwrap_err().contains("study of another scene"));
    let fewer = HashSet::from([rows[0].key.clone()]);
    assert!(open("one", &fewer, false).unwrap_err().contains(":4: 1.3, cpu, f64, 1 is not in this matrix"));
    assert!(open("two", &fewer, true).unwrap().rows.is_empty());
    std::fs::write(&path, "t,e\n0,1\n").unwrap();
    assert!(open("one", &wanted, true).unwrap_err().contains("is there and no study"));
    std::fs::remove_file(path).unwrap();
}

#[test]
fn the_front_holds_what_nothing_beats() {
    let points = [(1.0, 9.0), (2.0, 3.0), (2.0, 3.0), (2.5, 3.0), (3.0, 4.0), (4.0, 1.0), (0.5, f64::NAN), (f64::INFINITY, 0.0)];
    assert_eq!(front(&points), [true, true, true, false, false, true, false, false]);
    assert!(front(&[]).is_empty());
}

#[test]
fn the_cheapest_repeat_counts() {
    let expected = [("a", 0.1), ("b", 10.0)].map(|(name, tolerance)| Expected { name: name.into(), tolerance: Some(tolerance) });
    assert_eq!(worst(&[Some(0.05), Some(20.0)], &expected), Some(2.0));
    assert_eq!(worst(&[Some(0.05), None], &expected), None);
    assert_eq!(worst(&[Some(0.05), Some(f64::NAN)], &expected), None);
    assert_eq!(worst(&[Some(0.05)], &expected[..1]), Some(0.05));
    let failed = Row { cost: None, status: "failed: torn".into(), ..row(&["z"], 1, 0.0, &[0.0, 0.0]) };
    let rows = [row(&["x"], 1, 5.0, &[0.1, 0.0]), row(&["y"], 1, 3.0, &[0.2, 0.0]), row(&["x"], 2, 2.0, &[0.1, 0.0]), failed];
    let best = best(&rows, &expected);
    let told: Vec<_> = best.iter().map(|best| (best.row.key[0].as_str(), best.row.cpu_seconds(), best.on_front)).collect();
    assert_eq!(told, [("x", Some(2.0), true), ("y", Some(3.0), false)]);
}

#[test]
fn values_of_a_scene_are_overrides() {
    let text = Value::from(&toml::Value::String("none".into()));
    assert_eq!(text.shown, "none");
    let own = "[study.accuracy]\n\"formulation.xsph\" = [\"none\", 0.5]\n";
    assert_eq!(matrix(&[], own).unwrap().settings[0].overrides, ["formulation.xsph=\"none\""]);
}
