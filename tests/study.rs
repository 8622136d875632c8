//! `lithosph study` from outside.

mod cli_support;

use cli_support::{Said, Sandbox, said, signal, until};

/// A bar of 20 particles rings between free ends; the mean of its energy is known to no digit that matters here.
const BAR: &str = r#"title = "A bar"
dimension = 1
units = "dimensionless"
spacing = 0.05
duration = 0.5

[[body]]
name = "bar"
shape = { block = { min = [0], max = [1] } }
anchor = [0.025]
material = "rubber"
motion = { wave = { amplitude = [0.01], wave_vector = [3.141592653589793] } }

[material.rubber]
density = 1
youngs_modulus = 1
poisson_ratio = 0.3

[output]
series = 0.05

[observe]
total = { kind = "total_energy" }
momentum = { kind = "momentum", axis = "x" }

[expect.total]
value = 2.5e-5
tolerance = 0.01
relative = true
source = "rho v^2/2 over half a wave"

[expect.momentum]
between = [-1, 1]
because = "it is a test"
source = "nowhere"

[study.accuracy]
"time.cfl" = [0.2, 0.4]
"time.integrator" = ["leapfrog", "rk4"]
"#;

const FILE: &str = "out/study/bar-accuracy.csv";

fn bar(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    sandbox.write("bar.toml", BAR);
    sandbox
}

fn study(sandbox: &Sandbox, more: &[&str]) -> Said {
    sandbox.lithosph(&[&["study", "accuracy", "bar.toml"], more].concat())
}

fn text(sandbox: &Sandbox) -> String {
    std::fs::read_to_string(sandbox.path(FILE)).unwrap()
}

/// The rows by column name, sorted.
fn column(text: &str, names: &[&str]) -> Vec<Vec<String>> {
    let mut lines = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let titles = lines.next().unwrap();
    let place = |name: &&str| titles.iter().position(|title| title == name).unwrap_or_else(|| panic!("{name} in {titles:?}"));
    let places: Vec<usize> = names.iter().map(place).collect();
    let mut rows: Vec<Vec<String>> = lines.map(|cells| places.iter().map(|&k| cells[k].to_string()).collect()).collect();
    rows.sort();
    rows
}

/// Columns that are the same however often a study runs.
const SAME: [&str; 9] =
    ["time.cfl", "time.integrator", "precision", "repeat", "particles", "steps", "force_evaluations", "error_total", "status"];

#[test]
fn each_run_is_a_row_and_no_row_is_run_twice() {
    let sandbox = bar("rows");
    let options = ["--backend-list", "cpu32,cpu", "--repeats", "2"];
    let said = study(&sandbox, &options);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    assert!(said.out.starts_with("bar: 4 settings of time.cfl, time.integrator; 16 runs, into out/study"), "{said:?}");
    assert!(said.out.contains("Pareto front") && said.out.lines().any(|line| line.starts_with("* ")), "{said:?}");
    let first = text(&sandbox);
    let rows = column(&first, &SAME);
    assert_eq!(rows.len(), 16);
    for row in &rows {
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        let forces = if row[1] == "rk4" { 4.0 } else { 1.0 };
        assert_eq!((number(4), number(6), row[8].as_str()), (20.0, forces * number(5), "ok"), "{row:?}");
        assert!(number(7) < 0.01, "{row:?}");
    }
    let costs = column(&first, &["cpu_seconds", "wall_seconds", "bytes_per_particle"]);
    assert!(costs.iter().flatten().all(|cell| cell.parse::<f64>().unwrap() > 0.0), "{costs:?}");
    // Interleaved: all settings once, then again.
    let repeats: Vec<&str> = first.lines().skip(2).map(|line| line.split(',').nth(4).unwrap()).collect();
    assert_eq!(repeats, [["1"; 8], ["2"; 8]].concat());

    assert_eq!(study(&sandbox, &options).code, Some(0));
    assert_eq!(text(&sandbox), first);
    // Half of it, the last line cut: the rest is run, and what is left is kept to the byte.
    std::fs::write(sandbox.path(FILE), &first[..first.len() / 2]).unwrap();
    assert_eq!(study(&sandbox, &options).code, Some(0));
    let whole = first[..first.len() / 2].rfind('\n').unwrap();
    assert_eq!(text(&sandbox)[..whole], first[..whole]);
    assert_eq!(column(&text(&sandbox), &SAME), rows);
}

#[test]
fn a_file_of_another_study_is_refused() {
    let sandbox = bar("other");
    let refuse = |more: &[&str], words: &str| {
        let said = study(&sandbox, more);
        assert!(said.code == Some(2) && said.err.contains(words), "{said:?}");
    };
    assert_eq!(study(&sandbox, &["--vary", "time.cfl=0.2"]).code, Some(0));
    refuse(&["--vary", "time.cfl=0.4"], "0.2, cpu, f64, 1 is not in this matrix; --force");
    refuse(&["--vary", "formulation.smoothing_length=1.2"], "other paths or expectations; --force");
    // A longer matrix goes on.
    let row = text(&sandbox);
    assert_eq!(study(&sandbox, &["--vary", "time.cfl=0.4,0.2"]).code, Some(0));
    assert!(text(&sandbox).starts_with(&row) && text(&sandbox).lines().count() == 4);
    sandbox.write("bar.toml", &BAR.replace("duration = 0.5", "duration = 0.6"));
    refuse(&["--vary", "time.cfl=0.2"], "the scene or its reference has changed since; --force");
    assert_eq!(study(&sandbox, &["--vary", "time.cfl=0.2", "--force"]).code, Some(0));
    assert_eq!(text(&sandbox).lines().count(), 3);
}

#[test]
fn a_slip_is_refused_before_anything_runs() {
    let sandbox = bar("slip");
    let refuse = |more: &[&str], words: &[&str]| {
        let said = study(&sandbox, more);
        assert_eq!((said.code, said.out.as_str(), said.err.lines().count()), (Some(2), "", 1), "{said:?}");
        assert!(words.iter().all(|word| said.err.contains(word)) && !sandbox.exists("out"), "{said:?}");
    };
    refuse(&["--vary", "time.cfll=0.2,0.4"], &["--vary time.cfll: unknown key `cfll`, did you mean `cfl`?"]);
    refuse(&["--vary", "time.cfl=0.2,-1"], &["--vary time.cfl: ", "positive number, found -1"]);
    refuse(&["--observable", "momentum"], &["--observable momentum: no expectation with a value", "`total`"]);
    refuse(&["--variant", "fast"], &["unknown variant `fast`"]);
    sandbox.write("bar.toml", &BAR.replace("\"time.cfl\" =", "\"time.clf\" ="));
    let line = 1 + BAR[..BAR.find("\"time.cfl\"").unwrap()].matches('\n').count();
    refuse(&[], &[&format!("bar.toml:{line}: `time.clf`: unknown key `clf`")]);
}

#[test]
fn a_run_that_fails_is_a_row() {
    let sandbox = bar("fails");
    // A row every 0.05 would keep the steps short.
    let vary = ["time.cfl=0.2,30", "duration=100", "output.series=50", "body.bar.velocity=none,[0]"];
    let said = study(&sandbox, &vary.iter().flat_map(|axis| ["--vary", axis]).collect::<Vec<_>>());
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    let rows = column(&text(&sandbox), &["time.cfl", "cpu_seconds", "error_total"]);
    assert_eq!(rows.len(), 4);
    assert!(rows[..2].iter().all(|row| row[0] == "0.2" && !row[1].is_empty() && !row[2].is_empty()), "{rows:?}");
    assert!(rows[2..].iter().all(|row| row[0] == "30" && row[1].is_empty() && row[2].is_empty()), "{rows:?}");
    assert!(text(&sandbox).contains(",failed: bar: stopped after t = ") || text(&sandbox).contains(",\"failed: bar: stopped"));
    assert!(said.out.contains("30, 100, 50, none, cpu, f64, 1: failed: "), "{said:?}");
}

#[test]
fn an_interrupt_leaves_a_file_to_go_on_from() {
    let sandbox = bar("stop");
    let vary = ["--vary", "time.cfl=0.2", "--vary", "duration=0.5,4e4"];
    let child = sandbox.command(&[&["study", "accuracy", "bar.toml"], &vary[..]].concat()).spawn().unwrap();
    until("there is a row", || std::fs::read_to_string(sandbox.path(FILE)).is_ok_and(|text| text.lines().count() == 3));
    signal(&child, libc::SIGINT);
    let said = said(child);
    assert_eq!(said.code, Some(130), "{said:?}");
    assert!(said.err.contains("interrupted with 1 of 2 runs in out/study/bar-accuracy.csv"), "{said:?}");
    assert_eq!(column(&text(&sandbox), &["duration", "status"]), [["0.5", "ok"]]);
}

#[test]
fn a_scene_is_taken_apart() {
    let sandbox = bar("ablate");
    let ablate = |more: &[&str]| sandbox.lithosph(&[&["study", "ablate", "bar.toml"], more].concat());
    let said = ablate(&["--error", "0"]);
    assert!(said.code == Some(2) && said.err.contains("must be like `1%` or `0.01`") && !sandbox.exists("out"), "{said:?}");
    let said = ablate(&["--error", "5%"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    assert!(said.out.contains("lithosph run bar.toml --set ") && said.out.contains("Smallest model of bar"), "{said:?}");
    let file = "out/study/bar-ablate.csv";
    let first = std::fs::read_to_string(sandbox.path(file)).unwrap();
    assert!(first.lines().nth(1).unwrap().starts_with("run,without,overrides,repeat,particles,"), "{first}");
    assert_eq!(ablate(&["--error", "5%"]).out, said.out);
    assert_eq!(std::fs::read_to_string(sandbox.path(file)).unwrap(), first);
    let said = ablate(&["--set", "time.cfl=0.2"]);
    assert!(said.code == Some(2) && said.err.contains("study of another scene"), "{said:?}");
}

#[test]
fn a_scene_tells_what_it_pays_for() {
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
    let nowhere = sandbox.lithosph(&["study", "cost"]);
    assert!(nowhere.code == Some(2) && nowhere.err.contains("name scenes"), "{nowhere:?}");
}
