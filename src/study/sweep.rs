//! A sweep: a scene runs over a matrix of settings, and what it finds becomes a row of a CSV.
//!
//! Settings whose rows the file holds are not run again, so that the same command goes on where a kill left it.

use super::accuracy::matrix::Matrix;
use super::accuracy::source::Source;
use super::accuracy::table::line;
use crate::backend::Choice;
use crate::check;
use crate::observable::{KINDS, Value};
use crate::run::{self, Options, Stop};
use crate::scene::Scene;
use crate::scene::file::{Expect, Statistic};
use crate::scene::read::hint;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// What the command line asks of a sweep.
#[derive(Debug, Clone)]
pub struct Request {
    pub scene: PathBuf,
    pub variant: Option<String>,
    /// `path=value,value` for each axis.
    pub vary: Vec<String>,
    /// Numbers of the columns, each an observable or `OBSERVABLE.STATISTIC`; unless given all results, or where the scene has
    /// none the last, least and largest value of each series.
    pub numbers: Vec<String>,
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
    let columns = columns(&scene, &request.numbers).map_err(Stop::Refused)?;
    let path = request.out.clone().unwrap_or_else(|| format!("out/study/{}-sweep.csv", scene.label()).into());
    let header: Vec<String> = matrix.paths.iter().cloned().chain(columns.iter().map(|column| column.0.clone())).collect();
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
        let numbers = columns.iter().map(|column| number(&scene, &finished, column));
        let row = line(&setting.shown.iter().cloned().chain(numbers).collect::<Vec<_>>());
        tell(&row);
        append(&path, &row).map_err(Stop::Failed)?;
        rows.push(row);
    }
    Ok(std::iter::once(line(&header)).chain(rows).collect::<Vec<_>>().join("\n"))
}

/// Header, observable and, for a series, statistic of a number.
type Column = (String, String, Option<Statistic>);

/// The numbers that a sweep takes of each run.
fn columns(scene: &Scene, asked: &[String]) -> Result<Vec<Column>, String> {
    if !asked.is_empty() {
        return asked.iter().map(|text| column(scene, text)).collect();
    }
    let of_kind = |wanted: fn(&Value) -> bool| {
        let kinds = move |word: &str| KINDS.iter().any(|kind| kind.word == word && wanted(&kind.value));
        let names = scene.file.observe.iter().filter(move |(_, typed)| kinds(&typed.kind));
        names.map(|(name, _)| name.clone())
    };
    let results: Vec<Column> =
        of_kind(|value| matches!(value, Value::Result(_))).map(|name| (name.clone(), name, None)).collect();
    if !results.is_empty() {
        return Ok(results);
    }
    let of_series = |name: String| {
        let words = ["final", "min", "max"];
        words.map(|word| (format!("{name}.{word}"), name.clone(), Statistic::of_word(word)))
    };
    let series: Vec<Column> = of_kind(|value| matches!(value, Value::Series(_))).flat_map(of_series).collect();
    if series.is_empty() {
        let label = scene.label();
        return Err(format!("{label} observes nothing that is a number: a sweep needs a series or a result in [observe]"));
    }
    Ok(series)
}

/// `OBSERVABLE` or `OBSERVABLE.STATISTIC` as typed.
fn column(scene: &Scene, text: &str) -> Result<Column, String> {
    let (name, word) = text.split_once('.').map_or((text, None), |(name, word)| (name, Some(word)));
    let Some(typed) = scene.file.observe.get(name) else {
        let names: Vec<&str> = scene.file.observe.keys().map(String::as_str).collect();
        return Err(format!("--number {text}: {} observes no `{name}`{}", scene.label(), hint(name, &names)));
    };
    let kind = KINDS.iter().find(|kind| kind.word == typed.kind).map(|kind| &kind.value);
    let statistic = word.map(|word| {
        let words = Statistic::ALL.map(Statistic::word);
        Statistic::of_word(word).ok_or_else(|| format!("--number {text}: no statistic `{word}`{}", hint(word, &words)))
    });
    match (kind, statistic.transpose()?) {
        (Some(Value::Result(_)), Some(_)) => Err(format!("--number {text}: `{name}` is one number, which has no statistic")),
        (Some(Value::Trace), _) => Err(format!("--number {text}: `{name}` is a trace, not a number")),
        (_, statistic) => Ok((text.into(), name.into(), statistic)),
    }
}

/// A number of a run, or why there is none.
fn number(scene: &Scene, finished: &run::Finished, (_, name, statistic): &Column) -> String {
    let expect = Expect { statistic: *statistic, ..Expect::default() };
    check::number(scene, finished, name, &expect).map_or_else(|why| why, |number| number.to_string())
}

/// Rows of the file; makes it where there is none.
fn begin(path: &Path, header: &str) -> Result<Vec<String>, String> {
    let place = |error: std::io::Error| format!("{}: {error}", path.display());
    match std::fs::read(path) {
        Ok(bytes) => {
            let text = String::from_utf8_lossy(&bytes);
            let mut lines = text.lines().map(str::to_string);
            if lines.next().as_deref() == Some(header) {
                return Ok(lines.collect());
            }
            return Err(format!("{} is of another sweep, or none: name another file with --out", path.display()));
        }
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(place(error)),
        Err(_) => {}
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(place)?;
    }
    crate::output::durable::put(path, &[header.as_bytes(), b"\n"])?;
    Ok(Vec::new())
}

fn append(path: &Path, row: &str) -> Result<(), String> {
    let file = std::fs::OpenOptions::new().append(true).open(path);
    let written = file.and_then(|mut file| writeln!(file, "{row}"));
    written.map_err(|error| format!("{}: {error}", path.display()))
}
