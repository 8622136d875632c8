//! Each scene file is read with every variant, and what it marks `ci = true` is run on the CPU and compared with what it
//! expects: a test for each scene and each variant, found in the folder, so that a failure says which. Something is expected of
//! each variant, also of those that take too long for a test, and no tolerance is wider than twice the error.

use libtest_mimic::{Arguments, Failed, Trial};
use lithosph::backend::Choice;
use lithosph::check::{self, Verdict};
use lithosph::run::{Options, Stop, run};
use lithosph::scene::file::Expect;
use lithosph::scene::{Scene, read};
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).expect("there is a folder of scenes");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    files
}

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = Vec::new();
    for path in files() {
        let name = path.file_stem().expect("a file has a name").to_string_lossy().into_owned();
        for variant in variants(&path) {
            let label = format!("{name}::{}", variant.as_deref().unwrap_or("plain"));
            // A scene that cannot be read fails as a test of its own, below.
            if read::read(&path, variant.as_deref(), &[]).is_ok_and(|read| read.file.ci) {
                let path = path.clone();
                trials.push(Trial::test(label, move || gives_what_it_expects(&path, variant.as_deref())));
            }
        }
        trials.push(Trial::test(format!("{name}::reads_with_each_variant"), move || is_good(&path)));
    }
    assert!(!trials.is_empty(), "there are no scenes");
    libtest_mimic::run(&arguments, trials).exit();
}

/// No variant, then each; none of a file that is no scene.
fn variants(path: &Path) -> Vec<Option<String>> {
    let named = read::variants(path).unwrap_or_default();
    std::iter::once(None).chain(named.into_iter().map(Some)).collect()
}

fn is_good(path: &Path) -> Result<(), Failed> {
    read::read(path, None, &[])?.check_variants()?;
    for variant in variants(path) {
        let scene = Scene::open(path, variant.as_deref(), &[])?;
        if scene.particles.is_empty() || scene.file.source.is_empty() {
            return Err(format!("{} has no particle or names no source", scene.label()).into());
        }
        // A ratio that no physics makes is warned of, and no scene has one.
        if let Some(warning) = scene.warnings.iter().find(|warning| warning.contains("sound")) {
            return Err(warning.clone().into());
        }
        let expected: Vec<(&String, &Expect)> = scene.file.expect.iter().filter(|(_, e)| check::applies(&scene, e)).collect();
        if expected.is_empty() {
            return Err(format!("{}: nothing is expected of it, so that it could not fail", scene.label()).into());
        }
        if let Some((name, why)) = expected.iter().find_map(|(name, expect)| Some((name, check::typed_too_wide(expect)?))) {
            return Err(format!("{}: expect.{name}: {why}", scene.label()).into());
        }
    }
    Ok(())
}

/// An expectation without a variant of its own holds for all, so a variant that has any is worth its time.
fn gives_what_it_expects(path: &Path, variant: Option<&str>) -> Result<(), Failed> {
    let scene = Scene::open(path, variant, &[])?;
    let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
    let finished = run(&scene, &options).map_err(|stop| match stop {
        Stop::Refused(message) | Stop::Failed(message) | Stop::Interrupted(message) => message,
    })?;
    let rows = check::rows(&scene, &finished, &folder())?;
    // A wide tolerance hides the next mistake, and comes about when an error becomes smaller.
    if rows.iter().any(|row| row.verdict == Verdict::Miss || row.wide.is_some()) {
        return Err(check::text(&rows).into());
    }
    Ok(())
}
