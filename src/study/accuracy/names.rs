//! Short names of settings: of all their values only those that differ.

use super::matrix::{NONE, OWN, VARIANT};
use super::measure::brief;
use super::row::{RUN, Row};

/// Paths whose last word says less than the field's own sign does.
const SIGNS: [(&str, &str); 2] = [("spacing", "dx"), ("smoothing_length", "h/dx")];

/// Paths by whose values a chart colours its points, the first that differs.
const FAMILIES: [&str; 5] = [VARIANT, "formulation.kind", "time.integrator", "formulation.gradient", "spacing"];

/// The columns of a study's settings that tell them apart.
pub struct Names {
    /// Place in a row's subject, and the path's short word.
    differing: Vec<(usize, String)>,
    /// The one that makes families.
    family: Option<usize>,
}

impl Names {
    pub fn new<'a>(paths: &[String], rows: impl IntoIterator<Item = &'a Row>) -> Self {
        let rows: Vec<&Row> = rows.into_iter().collect();
        let columns: Vec<&str> = paths.iter().map(String::as_str).chain(RUN[..2].iter().copied()).collect();
        let differs = |k: &usize| rows.windows(2).any(|pair| pair[0].key.get(*k) != pair[1].key.get(*k));
        let differing: Vec<usize> = (0..columns.len()).filter(differs).collect();
        let family = FAMILIES.iter().find_map(|family| differing.iter().copied().find(|&k| columns[k] == *family));
        let family = family.or(differing.first().copied());
        Self { differing: differing.into_iter().map(|k| (k, sign(columns[k]))).collect(), family }
    }

    /// Of a row's setting.
    pub fn of(&self, row: &Row) -> String {
        let words = self.differing.iter().filter_map(|(k, sign)| word(sign, &row.key[*k]));
        Some(words.collect::<Vec<_>>().join(" ")).filter(|name| !name.is_empty()).unwrap_or_else(|| "as in the scene".into())
    }

    /// Of all settings that differ from others in what `fewer` leaves out: of a row, what they have in common.
    pub fn common(&self, fewer: &Self, row: &Row) -> String {
        let left = self.differing.iter().filter(|(k, _)| !fewer.differing.iter().any(|(other, _)| other == k));
        left.filter_map(|(k, sign)| word(sign, &row.key[*k])).collect::<Vec<_>>().join(" ")
    }

    /// What a row has in common with others of its colour.
    pub fn family(&self, row: &Row) -> String {
        let word = self.family.and_then(|k| {
            let sign = &self.differing.iter().find(|(other, _)| *other == k)?.1;
            word(sign, &row.key[k])
        });
        word.unwrap_or_else(|| "as in the scene".into())
    }
}

/// `time.cfl` is cfl, `formulation.smoothing_length` h/dx.
fn sign(path: &str) -> String {
    let last = path.rsplit('.').next().unwrap_or(path);
    SIGNS.iter().find(|(word, _)| *word == last).map_or(last, |(_, sign)| sign).replace('_', " ")
}

/// A number goes with its path's word, a word alone; nothing is said of the scene's own value.
fn word(sign: &str, value: &str) -> Option<String> {
    match value {
        OWN => None,
        NONE if sign == VARIANT => None,
        NONE => Some(format!("no {sign}")),
        "true" => Some(sign.to_string()),
        "false" => Some(format!("no {sign}")),
        number if number.parse::<f64>().is_ok() => Some(format!("{sign} {}", brief(number.parse().unwrap_or(f64::NAN)))),
        table if table.starts_with(['{', '[']) => {
            let inner = table.trim_matches(['{', '}', ' ']).replace(" = ", " ");
            Some(format!("{sign} {inner}"))
        }
        word => Some(word.replace('_', " ")),
    }
}
