//! What a run gives: a number for each expectation, and how far each observable is from the whole scene's.

use super::piece::Piece;
use super::plane;
use crate::check;
use crate::observable::{KINDS, ObservableKind, Table, Value};
use crate::run::Finished;
use crate::scene::Scene;
use crate::scene::file::{Expect, Norm, Statistic};
use std::path::Path;

/// An expectation of the whole scene.
#[derive(Debug, Clone)]
pub struct Expected {
    pub name: String,
    pub expect: Expect,
}

/// Expectations that hold for the scene's variant.
pub fn expected(scene: &Scene) -> Vec<Expected> {
    let known = scene.file.expect.iter().filter(|(_, expect)| check::applies(scene, expect));
    known.map(|(name, expect)| Expected { name: name.clone(), expect: expect.clone() }).collect()
}

impl Expected {
    /// Whether the number is an error; else it is what the observable came to, which a range bounds.
    pub fn is_error(&self) -> bool {
        self.expect.value.is_some() || self.expect.reference.is_some()
    }

    /// The number over what is tolerated: 1 is just good. In a range, the distance from its middle; of a known error, what the
    /// scene allows it to be at most.
    pub fn score(&self, number: f64) -> f64 {
        let share = |gap: f64, allowed: f64| if gap == 0.0 { 0.0 } else { gap / allowed };
        let tolerance = self.expect.tolerance.unwrap_or(0.0);
        match (self.expect.between, self.expect.seen) {
            (Some([low, high]), _) => share((number - 0.5 * (low + high)).abs(), 0.5 * (high - low)),
            (None, Some(seen)) if !self.is_error() => share((number - seen).abs(), tolerance * self.expect.unit().unwrap_or(1.0)),
            (None, Some(seen)) => share(number.abs(), self.known_error(seen) + tolerance),
            (None, None) => share(number.abs(), tolerance),
        }
    }

    /// The error of what is seen, in the unit of the tolerance.
    fn known_error(&self, seen: f64) -> f64 {
        self.expect.value.map_or(seen.abs(), |value| (seen - value).abs() / self.expect.unit().unwrap_or(1.0))
    }

    /// The same expectation with its error as a fraction, where it has a scale of its own.
    fn as_fraction(&self) -> Option<Expect> {
        let scaled = match (&self.expect.reference, self.expect.value) {
            (Some(_), _) => true,
            (None, Some(value)) => value != 0.0,
            (None, None) => false,
        };
        scaled.then(|| Expect { relative: self.expect.norm != Some(Norm::Phase), ..self.expect.clone() })
    }

    /// Number of a run, and the error as a fraction; none where the run does not tell.
    ///
    /// # Errors
    /// Why it does not.
    fn numbers(&self, run: &Run) -> Result<(f64, Option<f64>), String> {
        let name = &self.name;
        let typed = run.scene.file.observe.get(name).ok_or_else(|| format!("nothing observes `{name}`"))?;
        if run.piece.and_then(|piece| piece.ends).is_some_and(|end| self.judged_beyond(run.scene, end)) {
            return Err(format!("`{name}` is judged over the whole duration"));
        }
        let width = run.piece.and_then(|piece| piece.width).filter(|_| plane::is_sum(typed));
        if width.is_some() && self.expect.reference.is_some() {
            return Err(format!("the reference of `{name}` is that of the whole width"));
        }
        let of = |expect: &Expect| {
            let per_width = width.map_or_else(|| expect.clone(), |width| plane::per_width(expect, width));
            let factor = if expect.relative { 1.0 } else { width.unwrap_or(1.0) };
            let number = match self.is_error() {
                true => check::error(run.scene, run.finished, run.folder, name, &per_width),
                false => check::number(run.scene, run.finished, name, &per_width),
            };
            number.map(|number| number * factor)
        };
        Ok((of(&self.expect)?, self.as_fraction().map(|expect| of(&expect)).transpose()?))
    }

    /// Whether rows after a time count.
    fn judged_beyond(&self, scene: &Scene, end: f64) -> bool {
        let typed = &scene.file.observe[&self.name];
        let windowed = typed.between.is_some_and(|[_, last]| last <= end);
        let one = kind(&typed.kind).is_some_and(|kind| matches!(kind.value, Value::Result(_)));
        let last_row = matches!(self.expect.statistic.unwrap_or(Statistic::Final), Statistic::Final | Statistic::First);
        !(windowed || one || (last_row && self.expect.reference.is_none()))
    }
}

fn kind(word: &str) -> Option<&'static ObservableKind> {
    KINDS.iter().find(|kind| kind.word == word)
}

/// A finished run and the piece that it was without.
pub struct Run<'a> {
    pub scene: &'a Scene,
    pub finished: &'a Finished,
    pub folder: &'a Path,
    pub piece: Option<&'a Piece>,
}

/// Numbers of all expectations and their fractions, and the first reason why one has none.
pub fn of_expectations(all: &[Expected], run: &Run) -> (Vec<Option<f64>>, Option<String>) {
    let (mut numbers, mut missing) = (Vec::new(), None);
    for expected in all {
        match expected.numbers(run) {
            Ok((number, fraction)) => numbers.extend([Some(number), fraction]),
            Err(reason) => {
                numbers.extend([None, None]);
                missing = missing.or(Some(reason));
            }
        }
    }
    (numbers, missing)
}

/// Names of the observables that have a number: series, results and profiles.
pub fn observed(scene: &Scene) -> Vec<String> {
    let counts = |word: &str| kind(word).is_some_and(|kind| !matches!(kind.value, Value::Trace));
    scene.file.observe.iter().filter(|(_, typed)| counts(&typed.kind)).map(|(name, _)| name.clone()).collect()
}

/// What a run is compared with.
pub struct Whole<'a> {
    pub scene: &'a Scene,
    pub table: &'a Table,
}

/// For each observable its number at the end (of a profile the largest magnitude), the largest difference from the
/// whole scene's over the rows at the same times, and that over the whole scene's largest magnitude.
pub fn of_observables(names: &[String], whole: &Whole, run: &Run) -> Vec<Option<f64>> {
    let natural = Natural::of(whole.scene);
    let numbers = |name: &String| match compared(name, whole, run) {
        None => [None; 3],
        Some((number, change, scale)) => {
            let scale = scale.max(natural.floor(&whole.scene.file.observe[name].kind));
            [Some(number), Some(change), Some(if change == 0.0 { 0.0 } else { change / scale })]
        }
    };
    names.iter().flat_map(numbers).collect()
}

fn compared(name: &String, whole: &Whole, run: &Run) -> Option<(f64, f64, f64)> {
    let typed = run.scene.file.observe.get(name)?;
    let width = run.piece.and_then(|piece| piece.width).filter(|_| plane::is_sum(typed)).unwrap_or(1.0);
    if let Value::Result(of) = kind(&typed.kind)?.value {
        let (before, after) =
            (of(whole.table, &whole.scene.file.observe[name]).ok()?, width * of(&run.finished.table, typed).ok()?);
        return Some((after, (after - before).abs(), before.abs()));
    }
    let before = whole.table.columns.get(name)?;
    let own = series(run.finished).find(|(own, _)| *own == name)?.1;
    let after: Vec<f64> = own.iter().map(|value| width * value).collect();
    let scale = before.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let is_series = run.finished.table.columns.contains_key(name);
    let pairs: Vec<(usize, usize)> = if is_series { common(&whole.table.times, &run.finished.table.times) } else { vec![(0, 0)] };
    let gap = |&(a, b): &(usize, usize)| (after[b] - before[a]).abs();
    // NaN must not pass for no change.
    let change = pairs.iter().map(gap).fold(0.0, |most: f64, gap| if gap.is_nan() { gap } else { most.max(gap) });
    Some((*after.last()?, change, scale))
}

/// Series, and profiles as one number, the largest magnitude.
pub fn series(finished: &Finished) -> impl Iterator<Item = (&String, Vec<f64>)> {
    let largest = |rows: &Vec<(f64, f64)>| vec![rows.iter().fold(0.0, |most: f64, row| most.max(row.1.abs()))];
    let profiles = finished.profiles.iter().map(move |(name, rows)| (name, largest(rows)));
    finished.table.columns.iter().map(|(name, column)| (name, column.clone())).chain(profiles)
}

/// Places of rows at the same times.
fn common(a: &[f64], b: &[f64]) -> Vec<(usize, usize)> {
    let rounding = 1e-9 * a.iter().chain(b).fold(0.0, |most: f64, time| most.max(time.abs()));
    let (mut i, mut j, mut pairs) = (0, 0, Vec::new());
    while i < a.len() && j < b.len() {
        if (a[i] - b[j]).abs() <= rounding {
            pairs.push((i, j));
            (i, j) = (i + 1, j + 1);
        } else if a[i] < b[j] {
            i += 1;
        } else {
            j += 1;
        }
    }
    pairs
}

/// Scales of the scene as a whole, so that the rounding of a number that is zero is no change.
struct Natural {
    mass: f64,
    speed: f64,
    length: f64,
}

/// Part of the natural scale below which a number is none.
const ROUNDING: f64 = 1e-10;

impl Natural {
    fn of(scene: &Scene) -> Self {
        let (low, high) = scene.extent();
        let mass = (0..scene.particles.len()).map(|k| scene.mass(k)).sum();
        let speed = scene.bodies.iter().map(|body| body.material.sound_speed()).fold(0.0, f64::max);
        Self { mass, speed, length: (high - low).length() }
    }

    fn floor(&self, kind: &str) -> f64 {
        let scale = match kind {
            "momentum" => self.mass * self.speed,
            "angular_momentum" => self.mass * self.speed * self.length,
            "mean_velocity" | "rms_speed" | "obstacle_velocity" => self.speed,
            "mean_position" | "point_displacement" | "obstacle_displacement" => self.length,
            word if word.ends_with("_energy") => self.mass * self.speed * self.speed,
            _ => 0.0,
        };
        ROUNDING * scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expected(between: Option<[f64; 2]>, tolerance: Option<f64>) -> Expected {
        Expected { name: "e".into(), expect: Expect { between, tolerance, ..Expect::default() } }
    }

    #[test]
    fn a_known_error_may_be_as_large_as_it_is_known() {
        let of = |value, seen, tolerance| Expected {
            name: "e".into(),
            expect: Expect { value, seen: Some(seen), tolerance: Some(tolerance), ..Expect::default() },
        };
        assert_eq!(of(Some(1.0), 0.5, 0.25).score(0.75), 1.0);
        assert_eq!(of(None, 4.0, 2.0).score(6.0), 1.0);
    }

    #[test]
    fn a_score_of_one_is_just_good() {
        assert_eq!(expected(None, Some(0.1)).score(0.2), 2.0);
        assert_eq!(expected(None, Some(0.0)).score(0.0), 0.0);
        assert_eq!(expected(None, None).score(1e-9), f64::INFINITY);
        let range = expected(Some([2.0, 4.0]), None);
        assert_eq!((range.score(3.0), range.score(4.0), range.score(2.0), range.score(6.0)), (0.0, 1.0, 1.0, 3.0));
        assert!(range.score(f64::NAN).is_nan());
    }

    #[test]
    fn rows_at_the_same_times_are_found() {
        assert_eq!(common(&[0.0, 0.1, 0.2, 0.3], &[0.0, 0.2, 0.25, 0.3 + 1e-14]), [(0, 0), (2, 1), (3, 3)]);
        assert_eq!(common(&[0.0, 1.0], &[0.5]), []);
    }
}
