//! `lithosph study accuracy` and `lithosph study recommend` from outside.

use crate::common::sandbox::{Said, Sandbox, said, signal, until};

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

# An elastic wave, which no clumping disturbs.
[formulation]
artificial_stress = { epsilon = 0 }

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

pub fn bar(name: &str) -> Sandbox {
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
    assert!(said.out.contains("Pareto front") && said.out.lines().any(|line| line.starts_with('*')), "{said:?}");
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
fn slips_in_paths_values_and_names_are_refused_before_anything_runs() {
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
fn a_study_is_drawn_and_told_on_a_page() {
    let sandbox = bar("chart");
    let said = study(&sandbox, &[]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert!(said.out.contains("cheapest by particle-updates") && said.out.contains("0.3 %"), "{said:?}");
    let read = |end: &str| std::fs::read(sandbox.path(&FILE.replace(".csv", end))).unwrap();
    let (svg, page) = (String::from_utf8(read(".svg")).unwrap(), String::from_utf8(read(".html")).unwrap());
    assert!(read(".png").starts_with(b"\x89PNG"));
    for text in [&svg, &page] {
        assert!(text.contains("<svg") && text.contains("particle-updates") && text.contains("CPU seconds"), "{text}");
    }
    assert!(page.contains("The cheapest setting for an error") && page.contains("leapfrog") && !page.contains("<script"));
    // Judged by another error: other pictures, the same rows.
    let rows = text(&sandbox);
    let other = study(&sandbox, &["--kind", "fraction"]);
    assert_eq!((other.code, text(&sandbox)), (Some(0), rows), "{other:?}");
    assert!(sandbox.exists(&FILE.replace(".csv", "-fraction.png")));
}

#[test]
fn the_recommended_options_do_the_run_again() {
    let sandbox = bar("recommend");
    let recommend = |more: &[&str]| sandbox.lithosph(&[&["study", "recommend", "bar.toml"], more].concat());
    let said = recommend(&["--error", "1%", "--cost", "particle-updates"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    let rows =
        column(&text(&sandbox), &["particle_updates", "fraction_total", "time.cfl", "time.integrator", "steps", "particles"]);
    assert_eq!(rows.len(), 4);
    let number = |cell: &String| cell.parse::<f64>().unwrap();
    let good = rows.iter().filter(|row| number(&row[1]) <= 0.01);
    let best = good.min_by(|a, b| number(&a[0]).total_cmp(&number(&b[0]))).unwrap();
    let command = said.out.lines().find(|line| line.starts_with("lithosph run")).unwrap();
    assert!(command.contains(&format!("--set time.cfl={} ", best[2])) && command.contains(&best[3]), "{command}: {best:?}");
    // As a shell would split it: these words hold no space.
    let words: Vec<String> = command.split(' ').skip(1).map(|word| word.replace('\'', "")).collect();
    let run = sandbox.lithosph(&[words.iter().map(String::as_str).collect(), vec!["--out", "again"]].concat());
    assert_eq!(run.code, Some(0), "{run:?}");
    let summary = std::fs::read_to_string(sandbox.path("again/summary.json")).unwrap();
    let same = |name: &str, value: &str| summary.contains(&format!("\"{name}\": {value}"));
    assert!(same("steps", &best[4]) && same("particles", &best[5]), "{summary}: {best:?}");
    // The same as a variant.
    let (_, lines) = said.out.split_once("[variant.recommended]").unwrap();
    sandbox.write("bar.toml", &format!("{BAR}\n[variant.recommended]{lines}"));
    let run = sandbox.lithosph(&["run", "bar.toml", "--variant", "recommended", "--backend", "cpu", "--out", "variant"]);
    assert_eq!(run.code, Some(0), "{run:?}");
    let series = |folder: &str| std::fs::read_to_string(sandbox.path(&format!("{folder}/series.csv"))).unwrap();
    assert_eq!(series("variant"), series("again"));
}

#[test]
fn no_setting_is_recommended_for_an_error_that_none_reaches() {
    let sandbox = bar("unreached");
    let recommend = |error: &str| sandbox.lithosph(&["study", "recommend", "bar.toml", "--error", error]);
    let said = recommend("1e-9");
    assert_eq!((said.code, said.out.as_str(), said.err.lines().count()), (Some(1), "", 1), "{said:?}");
    assert!(said.err.contains("no setting has fraction_total of 1e-7 % or less; the nearest is cfl 0."), "{said:?}");
    // Nothing is run again.
    let rows = text(&sandbox);
    assert_eq!((recommend("1%").code, text(&sandbox)), (Some(0), rows));
    let said = recommend("0");
    assert!(said.code == Some(2) && said.err.contains("a number above 0"), "{said:?}");
}

#[test]
fn several_formulations_stand_in_one_study() {
    let sandbox = Sandbox::new("formulations");
    let matrix = BAR.find("[study.accuracy]").unwrap();
    let groups = "[variant.lagrangian]\nmaterial.rubber.law = \"neo_hookean\"\nformulation.kind = \"total_lagrangian\"\nformulation.artificial_stress = \"none\"\n\n\
                  [[study.accuracy]]\nvariant = [\"none\"]\n\"formulation.xsph\" = [\"none\", 0.5]\n\n\
                  [[study.accuracy]]\nvariant = [\"lagrangian\"]\n\"time.integrator\" = [\"leapfrog\", \"pefrl\"]\n";
    sandbox.write("bar.toml", &format!("{}{groups}", &BAR[..matrix]));
    let said = study(&sandbox, &[]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    let rows = column(&text(&sandbox), &["variant", "formulation.xsph", "time.integrator", "status"]);
    let expected = [
        ["lagrangian", "-", "leapfrog", "ok"],
        ["lagrangian", "-", "pefrl", "ok"],
        ["none", "0.5", "-", "ok"],
        ["none", "none", "-", "ok"],
    ];
    assert_eq!(rows, expected);
    let recommended = sandbox.lithosph(&["study", "recommend", "bar.toml", "--error", "50%"]);
    assert_eq!(recommended.code, Some(0), "{recommended:?}");
    // What the scene refuses is left out, and a slip is none of that.
    let vary = ["--vary", "variant=none,lagrangian", "--vary", "time.integrator=leapfrog,pefrl", "--out", "product.csv"];
    let said = study(&sandbox, &vary);
    assert!(said.code == Some(0) && said.out.contains("1 settings are left out"), "{said:?}");
    let said = study(&sandbox, &["--vary", "variant=none,lagrange", "--out", "slip.csv"]);
    assert!(said.code == Some(2) && said.err.contains("--vary variant: bar.toml: unknown variant `lagrange`"), "{said:?}");
    let said = study(&sandbox, &["--variant", "lagrangian"]);
    assert!(said.code == Some(2) && said.err.contains("leave --variant out"), "{said:?}");
}

#[test]
fn the_distance_from_a_reference_is_measured_in_four_ways() {
    let sandbox = Sandbox::new("kinds");
    let observed = "kinetic = { kind = \"kinetic_energy\" }\nslower = { kind = \"kinetic_energy\" }\n\n[expect.total]";
    let scene = BAR.replace("duration = 0.5", "duration = 3").replace("\n[expect.total]", observed);
    sandbox.write("bar.toml", &scene);
    let run = sandbox.lithosph(&["run", "bar.toml", "--backend", "cpu", "--out", "seen"]);
    assert_eq!(run.code, Some(0), "{run:?}");
    let series = std::fs::read_to_string(sandbox.path("seen/series.csv")).unwrap();
    let k = series.lines().next().unwrap().split(',').position(|name| name == "kinetic").unwrap();
    let rows = series.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>());
    let seen: Vec<(f64, f64)> = rows.map(|row| (row[0], row[k])).collect();
    // A quarter more than what is seen, and the same a tenth later.
    let table = |stretch: f64, scale: f64| {
        let rows = seen.iter().map(|(t, e)| format!("{:?},{:?}\n", stretch * t, scale * e));
        ["t,e\n".to_string()].into_iter().chain(rows).collect::<String>()
    };
    sandbox.write("more.csv", &table(1.0, 1.25));
    sandbox.write("later.csv", &table(1.1, 1.0));
    let expect = |name: &str, file: &str| {
        format!(
            "[expect.{name}]\nreference = \"{file}\"\ncolumns = [\"t\", \"e\"]\nnorm = \"rms\"\ntolerance = 1\nsource = \"a run\"\n\n"
        )
    };
    let matrix = scene.find("[study.accuracy]").unwrap();
    let text = format!("{}{}{}", &scene[..matrix], expect("kinetic", "more.csv"), expect("slower", "later.csv"));
    sandbox.write("bar.toml", &text);
    let said = study(&sandbox, &["--vary", "time.cfl=0.3"]);
    assert!(said.code == Some(0) && said.out.contains(" and rms_kinetic"), "{said:?}");
    let names = ["max_kinetic", "rms_kinetic", "final_kinetic", "phase_kinetic", "phase_slower"];
    let found: Vec<f64> = column(&self::text(&sandbox), &names)[0].iter().map(|cell| cell.parse().unwrap()).collect();
    let largest = seen.iter().fold(0.0, |largest: f64, row| largest.max(row.1));
    let square = seen.iter().map(|row| row.1 * row.1).sum::<f64>() / seen.len() as f64;
    let wanted = [0.2, 0.2 * square.sqrt() / largest, 0.2 * seen[seen.len() - 1].1 / largest, 0.0, 1.0 - 1.0 / 1.1];
    assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-6), "{found:?} {wanted:?}");
}

fn plate(sandbox: &Sandbox, more: &[&str]) -> Said {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/sheared_plate.toml");
    sandbox.lithosph(&[&["study", "accuracy", scene, "--vary", "output.series=0.06"], more].concat())
}

#[test]
fn the_total_lagrangian_needs_a_twentieth_of_the_eulerian_form() {
    let sandbox = Sandbox::new("twentieth");
    let (lagrangian, eulerian) = ("0.07692307692307693", "0.024390243902439025");
    let spacings = format!("spacing={lagrangian},{eulerian}");
    let vary = ["variant=coarse,eulerian_fine", "time.cfl=0.4", &spacings].map(|axis| ["--vary", axis]);
    let said = plate(&sandbox, &[&vary.concat()[..], &["--out", "plate.csv"]].concat());
    assert_eq!(said.code, Some(0), "{said:?}");
    let text = std::fs::read_to_string(sandbox.path("plate.csv")).unwrap();
    let rows = column(&text, &["variant", "spacing", "particle_updates", "max_corner", "error_total"]);
    let numbers = |variant: &str, spacing: &str| {
        let row = rows.iter().find(|row| row[0] == variant && row[1] == spacing).unwrap_or_else(|| panic!("{rows:?}"));
        row[2..].iter().map(|cell| cell.parse::<f64>().unwrap()).collect::<Vec<f64>>()
    };
    let (lagrangian, eulerian) = (numbers("coarse", lagrangian), numbers("eulerian_fine", eulerian));
    assert!((0.010..0.015).contains(&eulerian[1]), "{eulerian:?}");
    assert!(lagrangian[1] < eulerian[1] && 20.0 * lagrangian[0] < eulerian[0], "{lagrangian:?} {eulerian:?}");
    // In parts of the whole energy, 0.08.
    assert!(lagrangian[2] < 7e-4 && eulerian[2] > 0.02, "{lagrangian:?} {eulerian:?}");
}

#[test]
fn leapfrog_and_pefrl_are_the_front_of_energy() {
    let sandbox = Sandbox::new("integrators");
    let vary = ["--vary", "time.integrator=leapfrog,pefrl,ssp_rk3,rk4", "--vary", "time.cfl=0.1,0.2,0.4,0.8"];
    let said = plate(&sandbox, &[&vary[..], &["--observable", "total"]].concat());
    assert_eq!(said.code, Some(0), "{said:?}");
    let marked = said.out.lines().filter(|line| line.split_whitespace().next().is_some_and(|mark| mark.ends_with('+')));
    let marked: Vec<&str> = marked.filter(|line| line.contains("cpu f64")).collect();
    let holds = |word: &str| marked.iter().filter(|line| line.contains(word)).count();
    assert_eq!(holds("leapfrog") + holds("pefrl"), marked.len(), "{said:?}");
    assert!(holds("leapfrog") > 0 && holds("pefrl") > 0, "{said:?}");
}
