//! Each scene file is read with every variant, and what it marks `ci = true` is run on the CPU and compared with what
//! it expects: a module a scene, so that a failure says which.

use crate::common::{scene_file, scene_files, scene_folder};
use lithosph::backend::Choice;
use lithosph::check::{self, Verdict};
use lithosph::run::{Options, Stop, run};
use lithosph::scene::{Scene, read};
use std::collections::BTreeSet;

macro_rules! scenes {
    (run { $($run:ident),+ $(,)? } read { $($read:ident),+ $(,)? }) => {
        const NAMES: &[&str] = &[$(stringify!($run),)+ $(stringify!($read)),+];
        $(
            mod $run {
                #[test]
                fn is_good_with_each_of_its_variants() {
                    super::assert_good(stringify!($run));
                }
                #[test]
                fn gives_what_it_expects() {
                    super::assert_expectations(stringify!($run));
                }
            }
        )+
        $(
            mod $read {
                #[test]
                fn is_good_with_each_of_its_variants_and_marks_none_for_these_tests() {
                    super::assert_good(stringify!($read));
                    super::assert_unmarked(stringify!($read));
                }
            }
        )+
    };
}

scenes! {
    run {
        ball_bounce,
        ball_plane,
        ball_wall,
        buckling_strut,
        cantilever_3d,
        colliding_rings,
        flat_punch,
        free_bar,
        indentation_3d,
        oscillating_plate,
        plate_bending,
        plate_with_hole,
        rod_impact,
        rolling_ball,
        rotating_disc,
        sheared_plate,
        sheared_plate_shutov,
        sliding_ball,
        sliding_columns,
        tension_square,
        turek_hron,
        twisting_column,
        two_balls,
    }
    read {
        coating_indentation,
        indentation,
    }
}

/// The scene without a variant, then with each.
fn variants(name: &str) -> Vec<Scene> {
    let path = scene_file(name);
    let variants = read::variants(&path).unwrap_or_else(|error| panic!("{error}"));
    let words = std::iter::once(None).chain(variants.iter().map(|v| Some(v.as_str())));
    words.map(|word| Scene::open(&path, word, &[]).unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn assert_good(name: &str) {
    read::read(&scene_file(name), None, &[]).and_then(|read| read.check_variants()).unwrap_or_else(|error| panic!("{error}"));
    for scene in variants(name) {
        assert!(!scene.particles.is_empty(), "{} has no particle", scene.label());
        assert!(!scene.file.source.is_empty(), "{} names no source", scene.label());
    }
}

/// An expectation without a variant of its own holds for all, so a variant that has any is worth its time.
fn assert_expectations(name: &str) {
    let mut rows = Vec::new();
    for scene in variants(name).into_iter().filter(|scene| scene.file.ci) {
        let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
        let finished = run(&scene, &options).unwrap_or_else(|stop| match stop {
            Stop::Refused(message) | Stop::Failed(message) | Stop::Interrupted(message) => panic!("{message}"),
        });
        rows.extend(check::rows(&scene, &finished, &scene_folder()).unwrap_or_else(|error| panic!("{error}")));
    }
    println!("{}", check::text(&rows));
    assert!(!rows.is_empty(), "{name} marks nothing for these tests that expects anything");
    assert!(rows.iter().all(|row| row.verdict != Verdict::Miss), "{name} misses what it expects");
}

fn assert_unmarked(name: &str) {
    let marked: Vec<_> = variants(name).iter().filter(|scene| scene.file.ci).map(Scene::label).collect();
    assert!(marked.is_empty(), "{marked:?} is marked `ci = true` and belongs among the scenes that are run");
}

#[test]
fn each_file_has_a_module_of_its_own() {
    let files: BTreeSet<String> = scene_files()
        .iter()
        .map(|path| path.file_stem().and_then(|stem| stem.to_str()).expect("a name of letters").to_string())
        .collect();
    assert_eq!(NAMES.iter().map(|name| (*name).to_string()).collect::<BTreeSet<_>>(), files);
}
