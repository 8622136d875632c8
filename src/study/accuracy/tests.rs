use super::axis::{Axis, Value};
use super::chart::named;
use super::front::{Expected, best, front, worst};
use super::kind::ErrorKind;
use super::matrix::Matrix;
use super::measure::{Measures, brief};
use super::names::Names;
use super::parse_error;
use super::report::{goals, text};
use super::row::{COST, Cost, OK, RUN, Row, columns};
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
    let listed = refused(&[], "[[study.accuracy]]\n\n[[study.accuracy]]\n\"time.cfll\" = [1]\n");
    assert_eq!(listed, format!("s.toml:{}: `time.cfll`: unknown key `cfll`, did you mean `cfl`?", line + 2));
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
    let thousand = (0..200).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
    assert!(refused(&[&format!("a={thousand}"), &format!("b={thousand}")], "").contains("more than 10000 settings"));
}

#[test]
fn groups_stand_in_one_matrix() {
    let own = "[[study.accuracy]]\n\"time.cfl\" = [0.3, 0.1]\n\n[[study.accuracy]]\n\"time.integrator\" = [\"rk2\"]\n\"time.cfl\" = [0.3]\n\n\
               [[study.accuracy]]\n\"time.cfl\" = [0.3]\n";
    let matrix = matrix(&[], own).unwrap();
    assert_eq!(matrix.paths, ["time.cfl", "time.integrator"]);
    let shown: Vec<String> = matrix.settings.iter().map(|setting| setting.shown.join(" ")).collect();
    assert_eq!(shown, ["0.3 -", "0.1 -", "0.3 rk2"]);
    assert_eq!(matrix.settings[2].overrides, ["time.cfl=0.3", "time.integrator=\"rk2\""]);
}

#[test]
fn what_does_not_go_together_is_left_out() {
    let eulerian = refused(&["time.integrator=leapfrog,pefrl", "formulation.xsph=none,0.5"], "");
    assert!(eulerian.contains("pefrl"), "goes with nothing: {eulerian}");
    // It takes no viscosity, but each value goes with one of the other axis.
    let lagrangian = "[formulation]\nkind = \"total_lagrangian\"\n";
    let text = SCENE.replace("density = 1", "density = 1\nlaw = \"neo_hookean\"") + lagrangian;
    let vary = ["time.integrator=leapfrog,pefrl", "formulation.viscosity=none,{ alpha = 1 }"].map(String::from);
    let read = read::read_text(&text, "s.toml", None, &[]).unwrap();
    let matrix = Matrix::new(&vary, &read, |overrides| Scene::parse(&text, "s.toml", None, overrides)).unwrap();
    let (count, reason) = matrix.left_out.unwrap();
    assert_eq!((matrix.settings.len(), count), (3, 1));
    assert!(reason.contains("pefrl"), "{reason}");
}

#[test]
fn the_usual_matrix_leaves_out_what_means_nothing() {
    let usual = |text: &str, from: &str, to: &str| {
        let text = text.replace(from, to);
        let read = read::read_text(&text, "s.toml", None, &[]).unwrap();
        Matrix::new(&[], &read, |overrides| Scene::parse(&text, "s.toml", None, overrides)).unwrap()
    };
    let all = usual(SCENE, "", "");
    let eulerian =
        ["smoothing", "smoothing_length", "viscosity.alpha", "xsph", "gradient", "kind"].map(|key| format!("formulation.{key}"));
    assert_eq!(all.paths[..3], ["spacing", "time.integrator", "time.cfl"]);
    assert_eq!(all.paths[3..], eulerian);
    // PEFRL is for forces that depend on positions alone.
    assert_eq!(all.left_out.as_ref().map(|(count, _)| *count), Some(4));
    let count = |path: &str| {
        let k = all.paths.iter().position(|other| other == path).unwrap();
        all.settings.iter().filter(|setting| setting.shown[k] != "-").count()
    };
    assert_eq!((count("time.cfl"), count("formulation.smoothing"), count("formulation.xsph")), (12, 3, 2));
    let other = all.settings.last().unwrap();
    assert_eq!(other.shown.last().unwrap(), "total_lagrangian");
    assert!(other.overrides.contains(&"material.rubber.law=st_venant_kirchhoff".to_string()), "{other:?}");
    let anchored = usual(SCENE, "material = \"rubber\"", "material = \"rubber\"\nanchor = [0.05]");
    assert_eq!(anchored.paths[0], "time.integrator");
    let fixed = usual(SCENE, "[material", "[time]\nstep = 0.01\n[material");
    assert!(!fixed.paths.contains(&"time.cfl".to_string()));
    let law = "poisson_ratio = 0.3\nlaw = \"neo_hookean\"\n[formulation]\nkind = \"total_lagrangian\"";
    let lagrangian = usual(SCENE, "poisson_ratio = 0.3", law);
    assert!(lagrangian.paths.contains(&"formulation.hourglass".to_string()));
    assert_eq!(lagrangian.settings.iter().filter(|setting| setting.shown.contains(&"pefrl".to_string())).count(), 4);
    assert_eq!(lagrangian.settings.last().unwrap().shown.last().unwrap(), "eulerian");
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
    let names = columns(&["time.cfl".into()], vec!["error_front".into()]);
    assert_eq!(
        names.join(","),
        "time.cfl,backend,precision,repeat,particles,steps,force_evaluations,particle_updates,cpu_seconds,wall_seconds,bytes,bytes_per_particle,error_front,status"
    );
    assert!(Row::from_cells(vec!["1".into()], 2, 0).unwrap_err().contains("1 values for 2 columns"));
}

fn header(stamp: &str) -> Header {
    Header { stamp: stamp.into(), columns: columns(&["h".into()], vec!["error_front".into()]), errors: 1 }
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
    let best = best(&rows, &measures("a", "b"), Cost::CpuSeconds);
    let told: Vec<_> =
        best.iter().map(|best| (best.row.key[0].as_str(), best.row.cost_of(Cost::CpuSeconds), best.on_front)).collect();
    assert_eq!(told, [("x", Some(2.0), true), ("y", Some(3.0), false)]);
}

/// Of a scene with these two expectations; a name that ends in `%` is relative.
fn measures(first: &str, second: &str) -> Measures {
    let expect = |name: &str| match name.strip_suffix('%') {
        Some(name) => format!(
            "[observe.{name}]\nkind = \"total_energy\"\n[expect.{name}]\nvalue = 2\ntolerance = 0.1\nrelative = true\nsource = \"s\"\n"
        ),
        None => format!("[observe.{name}]\nkind = \"momentum\"\n[expect.{name}]\nvalue = 0\ntolerance = 0.1\nsource = \"s\"\n"),
    };
    let text = format!("{SCENE}{}{}", expect(first), expect(second));
    Measures::new(&Scene::parse(&text, "s", None, &[]).unwrap(), None, None).unwrap()
}

#[test]
fn settings_are_judged_by_one_error() {
    let both = measures("a", "b");
    assert_eq!(both.columns(), ["error_a", "error_b", "fraction_a", "fraction_b"]);
    assert_eq!((both.judged_by().as_str(), both.in_percent()), ("error/tolerance", false));
    let relative = measures("a", "b%");
    assert_eq!((relative.judged_by().as_str(), relative.in_percent()), ("fraction_b", true));
    assert_eq!(relative.error(&row(&["x"], 1, 1.0, &[9.0, 9.0, 0.5, 0.25])), Some(0.25));
    assert_eq!(both.error(&row(&["x"], 1, 1.0, &[9.0, 9.0, 0.5, 0.25])), Some(90.0));
    let scene = Scene::parse(
        &format!("{SCENE}[observe.a]\nkind = \"momentum\"\n[expect.a]\nvalue = 0\ntolerance = 1\nsource = \"s\"\n"),
        "s",
        None,
        &[],
    );
    let refused = Measures::new(&scene.unwrap(), None, Some(ErrorKind::Rms)).unwrap_err();
    assert_eq!(refused, "--kind rms: no such error of a");
}

#[test]
fn the_cheapest_setting_is_told_for_each_error() {
    let paths = ["time.cfl".to_string(), "time.integrator".to_string()];
    let run = |values: [&str; 2], seconds: f64, updates: f64, error: f64| {
        let mut row = row(&values, 1, seconds, &[error, 1.0, error, 1.0]);
        row.cost.as_mut().unwrap()[3] = updates;
        row
    };
    let rows = [
        run(["0.4", "leapfrog"], 1.0, 100.0, 0.05),
        run(["0.2", "leapfrog"], 2.0, 200.0, 0.01),
        run(["0.4", "pefrl"], 4.0, 150.0, 0.009),
        run(["0.2", "pefrl"], 8.0, 800.0, 0.005),
    ];
    let measures = measures("a%", "b");
    let told = goals(&paths, &measures, &rows);
    assert_eq!(
        told[0],
        ["error up to", "cheapest by CPU seconds", "CPU seconds", "cheapest by particle-updates", "particle-updates"]
    );
    assert_eq!(told[1], ["10 %", "cfl 0.4 leapfrog", "1", "cfl 0.4 leapfrog", "100"]);
    assert_eq!(told[2], ["3 %", "cfl 0.2 leapfrog", "2", "cfl 0.4 pefrl", "150"]);
    assert_eq!(told[3], ["1 %", "cfl 0.2 leapfrog", "2", "cfl 0.4 pefrl", "150"]);
    assert_eq!(told[4], ["0.3 %", "none", "-", "none", "-"]);
    let lines = text(&paths, &measures, &rows);
    let marks: Vec<&str> = lines.lines().skip(1).take(4).map(|line| line.split_whitespace().next().unwrap()).collect();
    assert_eq!(marks, ["*+", "*", "*+", "*+"], "{lines}");
}

#[test]
fn names_tell_what_differs() {
    let paths = ["variant", "spacing", "formulation.xsph", "formulation.viscosity"].map(String::from);
    let rows = [
        row(&["none", "0.047619047619047616", "0.5", "{ alpha = 1 }"], 1, 1.0, &[]),
        row(&["fine", "0.047619047619047616", "none", "-"], 1, 1.0, &[]),
    ];
    let names = Names::new(&paths, &rows);
    assert_eq!(names.of(&rows[0]), "xsph 0.5 viscosity alpha 1");
    assert_eq!(names.of(&rows[1]), "fine no xsph");
    assert_eq!((names.family(&rows[0]).as_str(), names.family(&rows[1]).as_str()), ("as in the scene", "fine"));
    assert_eq!(Names::new(&paths, &rows[..1]).of(&rows[0]), "as in the scene");
    let third = row(&["fine", "0.02", "none", "-"], 1, 1.0, &[]);
    let all = [rows[1].clone(), third, rows[0].clone()];
    let fewer = Names::new(&paths, &all[..2]);
    assert_eq!(
        (fewer.of(&all[1]).as_str(), Names::new(&paths, &all).common(&fewer, &all[1]).as_str()),
        ("dx 0.02", "fine no xsph")
    );
    assert_eq!([0.1, 0.012345, 123_456.0, 0.003].map(brief), ["0.1", "0.0123", "123000", "0.003"]);
}

#[test]
fn a_name_on_the_front_is_worth_a_tenth_of_the_error() {
    assert_eq!(named(&[1.38, 0.98, 0.93, 0.89, 0.87, 0.1]), [true, true, false, false, true, true]);
}

#[test]
fn an_error_is_a_number_or_percent() {
    assert_eq!(["1%", "0.3 %", "0.01"].map(parse_error), [Ok(0.01), Ok(0.003), Ok(0.01)]);
    assert!(parse_error("-1").unwrap_err().contains("a number above 0"));
}

#[test]
fn values_of_a_scene_are_overrides() {
    let text = Value::from(&toml::Value::String("none".into()));
    assert_eq!(text.shown, "none");
    let own = "[study.accuracy]\n\"formulation.xsph\" = [\"none\", 0.5]\n";
    assert_eq!(matrix(&[], own).unwrap().settings[0].overrides, ["formulation.xsph=\"none\""]);
}
