//! Every scene file is read with every variant, and those marked `ci = true` are run on the CPU and compared
//! with what they expect.

use lithosph::backend::Choice;
use lithosph::check::{self, Verdict};
use lithosph::run::{Options, Stop, run};
use lithosph::scene::{Scene, read};
use std::path::{Path, PathBuf};

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let entries = std::fs::read_dir(folder).expect("there is a folder of scenes");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    files
}

/// The scene without a variant, then each variant.
fn scenes(path: &Path) -> Vec<Scene> {
    let variants = read::variants(path).unwrap_or_else(|error| panic!("{error}"));
    let words = std::iter::once(None).chain(variants.iter().map(|v| Some(v.as_str())));
    words.map(|word| Scene::open(path, word, &[]).unwrap_or_else(|error| panic!("{error}"))).collect()
}

#[test]
fn every_scene_is_good_with_each_of_its_variants() {
    assert!(!files().is_empty());
    for path in files() {
        read::read(&path, None, &[]).and_then(|read| read.check_variants()).unwrap_or_else(|error| panic!("{error}"));
        for scene in scenes(&path) {
            assert!(!scene.particles.is_empty(), "{} has no particle", scene.label());
            assert!(!scene.file.source.is_empty(), "{} names no source", scene.label());
        }
    }
}

/// An expectation without a variant of its own holds for all, so a scene that has any is worth its time.
#[test]
fn scenes_marked_for_these_tests_give_what_they_expect() {
    let mut all = Vec::new();
    for path in files() {
        for scene in scenes(&path).into_iter().filter(|scene| scene.file.ci) {
            let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
            let finished = run(&scene, &options).unwrap_or_else(|stop| match stop {
                Stop::Refused(message) | Stop::Failed(message) | Stop::Interrupted(message) => panic!("{message}"),
            });
            let folder = path.parent().expect("a scene lies in a folder");
            all.extend(check::rows(&scene, &finished, folder).unwrap_or_else(|error| panic!("{error}")));
        }
    }
    assert!(!all.is_empty());
    assert!(all.iter().all(|row| row.verdict != Verdict::Miss), "{}", check::text(&all));
}
