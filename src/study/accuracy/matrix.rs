//! The matrix of a study: axes of override paths and their values, and the product of all axes.

use super::usual;
use crate::scene::Scene;
use crate::scene::read::Read;

/// More settings than this are taken for a slip.
const MOST_SETTINGS: usize = 10_000;

/// An override path and the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub path: String,
    pub values: Vec<Value>,
    /// Where it was typed, for errors.
    pub place: String,
}

/// One value of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Value {
    /// As an override takes it.
    typed: String,
    /// In one way however it was typed: `0.20` is `0.2`, and a word goes without quotes.
    pub shown: String,
}

/// A value for every axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setting {
    pub shown: Vec<String>,
    /// As [`Scene::open`] takes them.
    pub overrides: Vec<String>,
}

/// All settings of a study, each known to be a scene that can run.
#[derive(Debug)]
pub struct Matrix {
    pub paths: Vec<String>,
    pub settings: Vec<Setting>,
    /// How many combinations the scene refuses, and why it does so first; of the usual matrix only.
    pub left_out: Option<(usize, String)>,
}

impl Value {
    /// From TOML, or a bare word.
    pub fn parse(text: &str) -> Self {
        match text.parse::<toml::Value>() {
            Ok(value) => Self { typed: text.into(), ..Self::from(&value) },
            Err(_) => Self { typed: text.into(), shown: one_line(text) },
        }
    }
}

impl From<&toml::Value> for Value {
    fn from(value: &toml::Value) -> Self {
        let typed = value.to_string();
        let shown = one_line(value.as_str().unwrap_or(&typed));
        Self { typed, shown }
    }
}

impl Axis {
    /// # Errors
    /// One sentence where there is no value, or one comes twice.
    pub fn new(path: &str, place: String, values: Vec<Value>) -> Result<Self, String> {
        if values.is_empty() {
            return Err(format!("{place}: has no value"));
        }
        for (k, value) in values.iter().enumerate() {
            if values[..k].iter().any(|before| before.shown == value.shown) {
                return Err(format!("{place}: the value {} comes twice", value.shown));
            }
        }
        Ok(Self { path: path.into(), values, place })
    }

    /// From `path=value,value`.
    ///
    /// # Errors
    /// One sentence that begins with the option.
    pub fn parse(text: &str) -> Result<Self, String> {
        let Some((path, values)) = text.split_once('=') else {
            return Err(format!("--vary {text}: must be `path=value,value`, found no `=`"));
        };
        let (path, place) = (path.trim(), format!("--vary {}", path.trim()));
        let values: Vec<&str> = split(values).into_iter().map(str::trim).collect();
        if values.iter().any(|value| value.is_empty()) {
            return Err(format!("{place}: has an empty value"));
        }
        Self::new(path, place, values.into_iter().map(Value::parse).collect())
    }
}

/// Parts between the commas that lie outside brackets and quotes.
fn split(text: &str) -> Vec<&str> {
    let (mut parts, mut start, mut depth, mut quote, mut escaped) = (Vec::new(), 0, 0, None, false);
    for (at, letter) in text.char_indices() {
        match (quote, letter) {
            (Some('"'), '\\') if !escaped => {
                escaped = true;
                continue;
            }
            (Some(open), _) if open == letter && !escaped => quote = None,
            (None, '"' | '\'') => quote = Some(letter),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth -= 1,
            (None, ',') if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
        escaped = false;
    }
    parts.push(&text[start..]);
    parts
}

/// A text that fits into a row.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl Matrix {
    /// The matrix of the command line, else that of the scene, else the usual one; `open` makes a scene with overrides.
    ///
    /// # Errors
    /// One sentence on the first axis or combination that the scene refuses.
    pub fn new(vary: &[String], read: &Read, open: impl Fn(&[String]) -> Result<Scene, String>) -> Result<Self, String> {
        let typed = if vary.is_empty() { of_scene(read)? } else { of_options(vary)? };
        let axes = match typed.is_empty() {
            true => usual::axes(&open(&[])?),
            false => typed.clone(),
        };
        let paths = axes.iter().map(|axis| axis.path.clone()).collect();
        let (mut settings, mut refused) = (Vec::new(), Vec::new());
        for setting in product(&axes)? {
            match open(&setting.overrides) {
                Ok(_) => settings.push(setting),
                Err(reason) if typed.is_empty() => refused.push(reason),
                Err(reason) => return Err(at_axis(&axes, &setting, &reason)),
            }
        }
        if let ([], [reason, ..]) = (&settings[..], &refused[..]) {
            return Err(reason.clone());
        }
        let left_out = refused.first().map(|reason| (refused.len(), reason.clone()));
        Ok(Self { paths, settings, left_out })
    }
}

fn of_options(vary: &[String]) -> Result<Vec<Axis>, String> {
    let mut axes: Vec<Axis> = Vec::new();
    for text in vary {
        let axis = Axis::parse(text)?;
        if axes.iter().any(|before| before.path == axis.path) {
            return Err(format!("{}: is given twice", axis.place));
        }
        axes.push(axis);
    }
    Ok(axes)
}

fn of_scene(read: &Read) -> Result<Vec<Axis>, String> {
    let typed = read.file.study.accuracy.iter().flatten();
    let axis = |(path, values): (&String, &Vec<toml::Value>)| {
        let place = read.source.place(&["study", "accuracy", path]);
        Axis::new(path, format!("{place}: `{path}`"), values.iter().map(Value::from).collect())
    };
    typed.map(axis).collect()
}

/// Every combination, the first axis slowest.
fn product(axes: &[Axis]) -> Result<Vec<Setting>, String> {
    let count = axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.values.len()));
    if count.is_none_or(|count| count > MOST_SETTINGS) {
        return Err(format!("the matrix has more than {MOST_SETTINGS} settings: vary less"));
    }
    let extend = |settings: Vec<Setting>, axis: &Axis| {
        let with = |setting: &Setting, value: &Value| {
            let mut longer = setting.clone();
            longer.shown.push(value.shown.clone());
            longer.overrides.push(format!("{}={}", axis.path, value.typed));
            longer
        };
        settings.iter().flat_map(|setting| axis.values.iter().map(move |value| with(setting, value))).collect()
    };
    Ok(axes.iter().fold(vec![Setting::default()], extend))
}

/// A refusal with the place where the axis at fault was typed, or else with the values that do not go together.
fn at_axis(axes: &[Axis], setting: &Setting, reason: &str) -> String {
    let own = |axis: &Axis| Some(format!("{}: {}", axis.place, reason.strip_prefix(&format!("--set {}: ", axis.path))?));
    let overrides = || format!("{reason} (with {})", setting.overrides.join(", "));
    axes.iter().find_map(own).unwrap_or_else(overrides)
}
