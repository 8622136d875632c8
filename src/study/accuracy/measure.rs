//! What a study measures: the errors of a run, and the one of them that settings are judged by.

use super::axis::one_line;
use super::front::{Expected, worst};
use super::kind::ErrorKind;
use super::row::{OK, Row};
use crate::check;
use crate::observable::{KINDS, Value};
use crate::run::Finished;
use crate::scene::Scene;
use crate::scene::file::{Expect, Norm, Statement};
use crate::scene::read::hint;
use std::path::Path;

const OF_REFERENCE: [ErrorKind; 4] = [ErrorKind::Max, ErrorKind::Rms, ErrorKind::Final, ErrorKind::Phase];

/// Errors up to which the cheapest setting is told, over 1 or over a tolerance.
const GOALS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];

/// What a study measures, in the order of its columns: each expectation in the unit of its tolerance, then fractions.
#[derive(Debug, Clone)]
pub struct Measures {
    pub expected: Vec<Expected>,
    /// Index of an expectation, and how its distance is measured.
    fractions: Vec<(usize, ErrorKind)>,
    /// The fraction that settings are judged by; the largest error over its tolerance where there is none.
    judge: Option<usize>,
}

impl Measures {
    /// Of all expectations with a value or a reference that hold for the scene's variant, judged by the one that is named.
    ///
    /// # Errors
    /// One sentence where there is none, or none that can be measured as asked for.
    pub fn new(scene: &Scene, judge: Option<&str>, kind: Option<ErrorKind>) -> Result<Self, String> {
        let expected = expected(scene)?;
        let fractions: Vec<(usize, ErrorKind)> =
            expected.iter().enumerate().flat_map(|(k, e)| kinds(scene, &e.name).into_iter().map(move |kind| (k, kind))).collect();
        let judge = match (judge, kind) {
            (None, None) => usual_judge(scene, &expected, &fractions),
            _ => Some(asked(scene, &expected, &fractions, judge, kind)?),
        };
        Ok(Self { expected, fractions, judge })
    }

    /// Names of the columns.
    pub fn columns(&self) -> Vec<String> {
        let own = self.expected.iter().map(|expected| format!("error_{}", expected.name));
        own.chain(self.fractions.iter().map(|fraction| self.column(fraction))).collect()
    }

    fn column(&self, (k, kind): &(usize, ErrorKind)) -> String {
        format!("{}_{}", kind.word(), self.expected[*k].name)
    }

    /// Name of the error that settings are judged by.
    pub fn judged_by(&self) -> String {
        match (self.judge, &self.expected[..]) {
            (Some(k), _) => self.column(&self.fractions[k]),
            (None, [only]) => format!("error_{}", only.name),
            (None, _) => "error/tolerance".into(),
        }
    }

    /// Whether that is a column of its own unit, which there is anyway.
    pub fn judged_by_own(&self) -> bool {
        self.judge.is_none() && self.expected.len() == 1
    }

    /// The same in words, for the axis of a chart.
    pub fn about(&self) -> String {
        match (self.judge, &self.expected[..]) {
            (Some(k), _) => {
                let (k, kind) = self.fractions[k];
                format!("{} of {}, %", kind.about(), self.expected[k].name)
            }
            (None, [only]) => format!("error of {}", only.name),
            (None, _) => "largest of all errors over their tolerances".into(),
        }
    }

    /// Whether settings are judged by a fraction, which is told in percent.
    pub fn in_percent(&self) -> bool {
        self.judge.is_some()
    }

    /// An error as a reader wants it.
    pub fn shown(&self, error: f64) -> String {
        if self.in_percent() { format!("{} %", brief(100.0 * error)) } else { brief(error) }
    }

    /// Errors up to which the cheapest setting is told, each with its words.
    pub fn goals(&self) -> Vec<(f64, String)> {
        let tolerance = match &self.expected[..] {
            [only] => only.tolerance.unwrap_or(0.0),
            _ => 1.0,
        };
        let goal = |goal: f64| match self.in_percent() {
            true => (goal, self.shown(goal)),
            false => (100.0 * goal * tolerance, format!("{} of the tolerance", brief(100.0 * goal))),
        };
        GOALS.map(goal).into_iter().filter(|goal| goal.0 > 0.0).collect()
    }

    /// The error that a row is judged by.
    pub fn error(&self, row: &Row) -> Option<f64> {
        let (own, fractions) = row.errors.split_at_checked(self.expected.len())?;
        match self.judge {
            Some(k) => fractions.get(k).copied().flatten().filter(|error| error.is_finite()),
            None => worst(own, &self.expected),
        }
    }

    /// Errors of a finished run, and its status. Where a variant takes an expectation's value away, as what it is known to
    /// miss, that of the scene stands.
    pub fn measure(&self, scene: &Scene, base: &Scene, finished: &Finished, folder: &Path) -> (Vec<Option<f64>>, String) {
        let expect = |k: usize| {
            let name = &self.expected[k].name;
            let has = |scene: &'_ Scene| scene.file.expect.get(name).filter(|expect| measurable(expect)).cloned();
            match has(scene).or_else(|| has(base)) {
                Some(expect) if scene.file.observe.contains_key(name) => Ok((name, expect)),
                _ => Err(format!("{name}: this setting takes it away")),
            }
        };
        let own = |k: usize| expect(k).and_then(|(name, e)| check::error(scene, finished, folder, name, &e));
        let own: Vec<Result<f64, String>> = (0..self.expected.len()).map(own).collect();
        let fraction = |&(k, kind): &(usize, ErrorKind)| {
            let (name, expect) = expect(k).ok()?;
            let found = match kind.norm() {
                None => check::fraction(scene, finished, name, &expect),
                norm => check::error(scene, finished, folder, name, &Expect { norm, relative: true, ..expect }),
            };
            found.ok().filter(|error| error.is_finite())
        };
        let wrong = own.iter().find_map(|error| error.as_ref().err());
        let status = wrong.map_or_else(|| OK.to_string(), |reason| format!("no error: {}", one_line(reason)));
        let errors = own.iter().map(|error| error.as_ref().ok().copied()).chain(self.fractions.iter().map(fraction));
        (errors.collect(), status)
    }
}

/// A number in three digits.
pub fn brief(number: f64) -> String {
    let rounded: f64 = format!("{number:.2e}").parse().unwrap_or(number);
    crate::output::csv::shortest(rounded)
}

fn measurable(expect: &Expect) -> bool {
    expect.value.is_some() || expect.reference.is_some()
}

fn expected(scene: &Scene) -> Result<Vec<Expected>, String> {
    let known = scene.file.expect.iter().filter(|(_, expect)| check::applies(scene, expect) && measurable(expect));
    // Of a known error the tolerance bounds its change, not itself.
    let bound = |expect: &Expect| expect.tolerance.filter(|_| expect.kind == Statement::Truth);
    let expected = |(name, expect): (&String, &Expect)| Expected { name: name.clone(), tolerance: bound(expect) };
    let all: Vec<Expected> = known.map(expected).collect();
    match all.is_empty() {
        true => Err(format!("{} expects no value and names no reference, so that there is no error", scene.label())),
        false => Ok(all),
    }
}

/// Fractions that an expectation has: of a value 0 only where there is a series to compare with.
fn kinds(scene: &Scene, name: &str) -> Vec<ErrorKind> {
    let expect = &scene.file.expect[name];
    let word = &scene.file.observe[name].kind;
    let single = KINDS.iter().any(|kind| kind.word == word && matches!(kind.value, Value::Result(_)));
    match (&expect.reference, expect.value) {
        (Some(_), _) => OF_REFERENCE.to_vec(),
        (None, Some(value)) if value != 0.0 || !single => vec![ErrorKind::Fraction],
        _ => Vec::new(),
    }
}

/// The fraction of a named expectation, of a kind, or both.
fn asked(
    scene: &Scene,
    expected: &[Expected],
    fractions: &[(usize, ErrorKind)],
    name: Option<&str>,
    kind: Option<ErrorKind>,
) -> Result<usize, String> {
    let names: Vec<&str> = expected.iter().map(|expected| expected.name.as_str()).collect();
    let own = |k: usize| {
        let expect = &scene.file.expect[names[k]];
        if expect.reference.is_some() { expect.norm.unwrap_or(Norm::Max) } else { Norm::Final }
    };
    let index =
        match name {
            None => None,
            Some(name) => Some(names.iter().position(|other| *other == name).ok_or_else(|| {
                format!("--observable {name}: no expectation with a value or a reference{}", hint(name, &names))
            })?),
        };
    let fits = |&(k, found): &(usize, ErrorKind)| {
        let as_asked = match kind {
            Some(kind) => found == kind,
            None => found == ErrorKind::Fraction || found.norm() == Some(own(k)),
        };
        as_asked && index.is_none_or(|index| index == k)
    };
    let missing = || match (name, kind) {
        (Some(name), None) => format!("--observable {name}: its error has nothing to be a fraction of"),
        (_, kind) => {
            let of = name.map_or_else(|| names.join(", "), str::to_string);
            format!("--kind {}: no such error of {of}", kind.map_or("", ErrorKind::word))
        }
    };
    fractions.iter().position(fits).ok_or_else(missing)
}

/// The first expectation with a reference, in its own norm; else the first that is relative; else the only one.
fn usual_judge(scene: &Scene, expected: &[Expected], fractions: &[(usize, ErrorKind)]) -> Option<usize> {
    let expect = |k: usize| &scene.file.expect[&expected[k].name];
    let own_norm = |&(k, kind): &(usize, ErrorKind)| {
        expect(k).reference.is_some() && kind.norm() == Some(expect(k).norm.unwrap_or(Norm::Max))
    };
    let relative = |&(k, kind): &(usize, ErrorKind)| kind == ErrorKind::Fraction && expect(k).relative;
    let only = || (expected.len() == 1 && fractions.len() == 1).then_some(0);
    fractions.iter().position(own_norm).or_else(|| fractions.iter().position(relative)).or_else(only)
}
