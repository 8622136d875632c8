//! `lithosph study ablate` from outside.

use super::accuracy::bar;

#[test]
fn a_scene_is_taken_apart_and_no_run_is_done_twice() {
    let sandbox = bar("ablate");
    let ablate = |more: &[&str]| sandbox.lithosph(&[&["study", "ablate", "bar.toml"], more].concat());
    let said = ablate(&["--error", "0"]);
    assert!(said.code == Some(2) && said.err.contains("a number above 0") && !sandbox.exists("out"), "{said:?}");
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
