//! Runs scenes and compares them with what they expect.

use super::Where;
use super::say::say;
use crate::check::{self, Record, Row, Verdict};
use crate::run::{self, INTERRUPTED, Options, Stop};
use crate::scene::{self, Scene};
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Duration;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Only this variant (`none`: the scene as it is); all, and the scene as it is, unless given.
    #[arg(long)]
    variant: Option<String>,
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Only scenes marked `ci = true`, which run in seconds.
    #[arg(long)]
    ci: bool,
    /// Keep rows in this file as they come, and take from it those that this program has found of the same scenes, so that a
    /// check that was stopped goes on.
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Give up a run that takes longer, and say so in its row; quick scenes come first.
    #[arg(long, value_name = "SECONDS")]
    within: Option<f64>,
    #[command(flatten)]
    place: Where,
}

/// A scene with one of its variants, and what was found of it.
struct Case {
    path: PathBuf,
    variant: Option<String>,
    slow: bool,
    rows: Vec<Row>,
}

pub(super) fn check(args: &Arguments) -> Result<i32, Stop> {
    args.place.set_threads()?;
    let device = format!("{:?}", args.place.choice()?);
    let record = args.record.as_ref().map(|path| Record::open(path, &device)).transpose().map_err(Stop::Refused)?;
    let mut cases = Vec::new();
    for path in &args.scenes {
        cases.extend(cases_of(path, args).map_err(Stop::Refused)?);
    }
    // What takes hours should not stand before what takes seconds; the table has the order of the files.
    for slow in [false, true] {
        for case in cases.iter_mut().filter(|case| case.slow == slow) {
            case.rows = found(case, args, record.as_ref())?;
        }
    }
    let rows: Vec<Row> = cases.into_iter().flat_map(|case| case.rows).collect();
    say(check::text(&rows).trim_end());
    Ok(i32::from(rows.iter().any(|row| row.verdict == Verdict::Miss)))
}

/// All that is to be run of one file. A slip in the last variant should not show only after the others have run.
fn cases_of(path: &Path, args: &Arguments) -> Result<Vec<Case>, String> {
    let plain = scene::read::read(path, None, &[])?;
    plain.check_variants()?;
    let variants: Vec<Option<String>> = match &args.variant {
        Some(word) if word == "none" => vec![None],
        Some(word) => vec![Some(word.clone())],
        None => std::iter::once(None).chain(scene::read::variants(path)?.into_iter().map(Some)).collect(),
    };
    let mut cases = Vec::new();
    for variant in variants {
        let file = scene::read::read(path, variant.as_deref(), &args.set)?.file;
        check::references(&file, folder(path))?;
        cases.push(Case { path: path.into(), variant, slow: !file.ci, rows: Vec::new() });
    }
    cases.retain(|case| !(args.ci && case.slow));
    Ok(cases)
}

fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new("."))
}

/// A run that nothing is expected of would only cost time.
fn expects_something(scene: &Scene) -> bool {
    scene.file.expect.values().any(|expect| check::applies(scene, expect))
}

fn found(case: &Case, args: &Arguments, record: Option<&Record>) -> Result<Vec<Row>, Stop> {
    let scene = Scene::open(&case.path, case.variant.as_deref(), &args.set).map_err(Stop::Refused)?;
    let folder = folder(&case.path);
    if !expects_something(&scene) {
        return Ok(Vec::new());
    }
    if let Some(rows) = record.and_then(|record| record.rows(&scene, folder)) {
        return Ok(rows);
    }
    let options = Options {
        choice: args.place.choice()?,
        dry: true,
        quiet: args.place.quiet,
        within: args.within.map(Duration::from_secs_f64),
        ..Options::default()
    };
    let rows = match run::run(&scene, &options) {
        Ok(finished) => check::rows(&scene, &finished, folder).map_err(Stop::Refused)?,
        // The table shall not be lost for one run of many.
        Err(Stop::Failed(reason)) => vec![check::failed(&scene, reason, Verdict::Miss)],
        Err(Stop::Interrupted(reason)) if !INTERRUPTED.load(Ordering::Relaxed) => {
            return Ok(vec![check::failed(&scene, reason, Verdict::Unfinished)]);
        }
        Err(stop) => return Err(stop),
    };
    if let Some(record) = record {
        record.add(&scene, folder, &rows).map_err(Stop::Failed)?;
    }
    Ok(rows)
}
