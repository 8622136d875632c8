//! A sweep: a scene runs over a matrix of settings, and what it finds becomes a row of a CSV.
//!
//! Settings whose rows the file holds are not run again, so that the same command goes on where a kill left it.

use super::accuracy::matrix::Matrix;
use super::accuracy::source::Source;
use super::accuracy::table::line;
use crate::backend::Choice;
use crate::observable::{KINDS, Value};
use crate::run::{self, Options, Stop};
use crate::scene::Scene;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// What the command line asks of a sweep.
#[derive(Debug, Clone)]
pub struct Request {
    pub scene: PathBuf,
    pub variant: Option<String>,
    /// `path=value,value` for each axis.
    pub vary: Vec<String>,
    pub choice: Choice,
    /// `out/study/SCENE[-VARIANT]-sweep.csv` unless given.
    pub out: Option<PathBuf>,
}

/// Runs what the file lacks; gives its text.
///
/// # Errors
/// A setting that is refused, a file of another sweep, a run that fails, or the user.
pub fn run(request: &Request, mut tell: impl FnMut(&str)) -> Result<String, Stop> {
    let source = Source::new(request.scene.clone(), request.variant.clone()).map_err(Stop::Refused)?;
    let read = source.read().map_err(Stop::Refused)?;
    if request.vary.is_empty() {
        return Err(Stop::Refused("a sweep needs --vary PATH=V1,V2".into()));
    }
    let matrix = Matrix::new(&request.vary, &read, |overrides| source.open(overrides)).map_err(Stop::Refused)?;
    let scene = source.open(&[]).map_err(Stop::Refused)?;
    let names = results(&scene);
    if names.is_empty() {
        return Err(Stop::Refused(format!("{} finds no result: a sweep needs one in [observe]", scene.label())));
    }
    let path = request.out.clone().unwrap_or_else(|| format!("out/study/{}-sweep.csv", scene.label()).into());
    let header: Vec<String> = matrix.paths.iter().cloned().chain(names.iter().cloned()).collect();
    let mut rows = begin(&path, &line(&header)).map_err(Stop::Refused)?;
    if let Some((count, reason)) = &matrix.left_out {
        tell(&format!("{count} settings are left out, the first because {reason}"));
    }
    for setting in &matrix.settings {
        let key = line(&setting.shown);
        if rows.iter().any(|row| row.starts_with(&format!("{key},"))) {
            continue;
        }
        let scene = source.open(&setting.overrides).map_err(Stop::Refused)?;
        let options = Options { choice: request.choice.clone(), dry: true, quiet: true, ..Options::default() };
        let finished = run::run(&scene, &options)?;
        let numbers = names.iter().map(|name| number(&scene, &finished, name));
        let row = line(&setting.shown.iter().cloned().chain(numbers).collect::<Vec<_>>());
        tell(&row);
        append(&path, &row).map_err(Stop::Failed)?;
        rows.push(row);
    }
    Ok(std::iter::once(line(&header)).chain(rows).collect::<Vec<_>>().join("\n"))
}

/// Observables that are found from a finished run.
fn results(scene: &Scene) -> Vec<String> {
    let found = |word: &str| KINDS.iter().any(|kind| kind.word == word && matches!(kind.value, Value::Result(_)));
    scene.file.observe.iter().filter(|(_, typed)| found(&typed.kind)).map(|(name, _)| name.clone()).collect()
}

/// A result of a run, or why there is none.
fn number(scene: &Scene, finished: &run::Finished, name: &str) -> String {
    let typed = &scene.file.observe[name];
    let kind = KINDS.iter().find(|kind| kind.word == typed.kind).map(|kind| &kind.value);
    match kind {
        Some(Value::Result(of)) => of(&finished.table, typed).map_or_else(|why| why, |number| number.to_string()),
        _ => String::new(),
    }
}

/// Rows of the file; makes it where there is none.
fn begin(path: &Path, header: &str) -> Result<Vec<String>, String> {
    let place = |error: std::io::Error| format!("{}: {error}", path.display());
    if let Ok(text) = std::fs::read_to_string(path) {
        let mut lines = text.lines().map(str::to_string);
        if lines.next().as_deref() == Some(header) {
            return Ok(lines.collect());
        }
        return Err(format!("{} is of another sweep: name another file with --out", path.display()));
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(place)?;
    }
    std::fs::write(path, format!("{header}\n")).map_err(place)?;
    Ok(Vec::new())
}

fn append(path: &Path, row: &str) -> Result<(), String> {
    let file = std::fs::OpenOptions::new().append(true).open(path);
    let written = file.and_then(|mut file| writeln!(file, "{row}"));
    written.map_err(|error| format!("{}: {error}", path.display()))
}
