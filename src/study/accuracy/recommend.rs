//! The cheapest setting of a study that reaches an error, as something to type.

use super::front::{Best, best, cheapest, most_accurate};
use super::matrix::{NONE, Setting};
use super::measure::brief;
use super::row::{Cost, Row};
use super::source::Source;
use super::{Study, names::Names};
use crate::run::Stop;
use std::fmt::Write as _;

/// Tables that are lists, whose elements a variant merges by name.
const LISTS: [&str; 6] = ["body", "contact", "boundary", "obstacle", "symmetry", "kick"];

/// "1%" or "0.01".
///
/// # Errors
/// One sentence that begins with the option.
pub fn parse_error(text: &str) -> Result<f64, String> {
    let (number, scale) = text.trim().strip_suffix('%').map_or((text.trim(), 1.0), |number| (number.trim(), 100.0));
    match number.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number / scale),
        _ => Err(format!("must be a number above 0 such as 0.01 or 1%, found {text}")),
    }
}

impl Study {
    /// Runs what the file lacks; gives the options of the cheapest setting whose error is no larger.
    ///
    /// # Errors
    /// As [`Study::run`]; or no setting comes so near.
    pub fn recommend(&self, error: f64, cost: Cost) -> Result<String, Stop> {
        let rows = self.rows()?;
        let all = best(&rows, &self.measures, cost);
        let (asked, judged) = (self.measures.shown(error), self.measures.judged_by());
        let names = Names::new(&self.matrix.paths, &rows);
        let Some(found) = cheapest(&all, error) else {
            return Err(Stop::Failed(match most_accurate(&all) {
                Some(nearest) => format!(
                    "{}: no setting has {judged} of {asked} or less; the nearest is {}, {} at {}",
                    self.label,
                    names.of(nearest.row),
                    self.measures.shown(nearest.error.unwrap_or(f64::NAN)),
                    price(nearest.row)
                ),
                None => format!("{}: no run came to its end with {judged}", self.label),
            }));
        };
        let Best { row, error, .. } = found;
        let reached = error.map_or_else(String::new, |error| self.measures.shown(error));
        let mut out = format!("{}, {}: {judged} {reached} at {}\n", self.label, names.of(row), price(row));
        if let Some(setting) = self.matrix.settings.iter().find(|setting| row.key.starts_with(&setting.shown)) {
            out += &options(&self.source, setting, row);
        }
        Ok(out.trim_end().to_string())
    }
}

fn price(row: &Row) -> String {
    let number = |cost: Cost| row.cost_of(cost).map_or_else(String::new, brief);
    let words = |cost: Cost| format!("{} {}", number(cost), cost.about());
    [Cost::ParticleUpdates, Cost::CpuSeconds].map(words).join(", ")
}

/// The command that does the run again, and the same as lines of the scene.
fn options(source: &Source, setting: &Setting, row: &Row) -> String {
    let (variant, overrides) = source.chosen(&setting.overrides);
    let mut command = format!("lithosph run {}", quoted(&source.path().display().to_string()));
    if let Some(variant) = &variant {
        let _ = write!(command, " --variant {variant}");
    }
    for text in &overrides {
        let _ = write!(command, " --set {}", quoted(text));
    }
    let place = &row.subject()[setting.shown.len()..];
    let _ = write!(command, " --backend {}", place[0]);
    if place[0] == "cpu" && place[1] == "f32" {
        command += " --precision f32";
    }
    let lines: Vec<String> = overrides.iter().filter_map(|text| line(text)).collect();
    if lines.is_empty() {
        return command;
    }
    format!("{command}\n\n[variant.{}]\n{}", variant.as_deref().unwrap_or("recommended"), lines.join("\n"))
}

/// An override as a line of TOML in a variant; `None` where it goes into a list.
fn line(text: &str) -> Option<String> {
    let (path, value) = text.split_once('=')?;
    let list = LISTS.contains(&path.split('.').next().unwrap_or_default());
    let whole = value.parse::<toml::Value>().is_ok() && value != NONE;
    let value = if whole { value.to_string() } else { format!("\"{value}\"") };
    (!list).then(|| format!("{path} = {value}"))
}

/// As a shell takes it for one word.
pub fn quoted(text: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "._-=/+".contains(letter);
    if text.chars().all(plain) { text.into() } else { format!("'{}'", text.replace('\'', "'\\''")) }
}
