//! The matrix of a study: groups of axes, each an override path and its values, and the product of the axes of each.

use super::axis::{Axis, Value};
use super::usual;
use crate::scene::Scene;
use crate::scene::read::Read;
use std::collections::BTreeMap;

/// The path whose values are the scene's variants, [`NONE`] for the scene without one.
pub const VARIANT: &str = "variant";
pub const NONE: &str = "none";

/// Stands for the scene's own value where a group does not name a path that another does.
pub const OWN: &str = "-";

/// More settings than this are taken for a slip.
const MOST_SETTINGS: usize = 10_000;

/// A value for every axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setting {
    pub shown: Vec<String>,
    /// As [`Scene::open`] takes them.
    pub overrides: Vec<String>,
}

impl Setting {
    /// The override that chooses a variant.
    pub fn variant(&self) -> Option<String> {
        self.overrides.iter().find(|text| text.starts_with("variant=")).cloned()
    }
}

/// All settings of a study, each known to be a scene that can run.
#[derive(Debug)]
pub struct Matrix {
    pub paths: Vec<String>,
    pub settings: Vec<Setting>,
    /// How many combinations the scene refuses, and why it does so first.
    pub left_out: Option<(usize, String)>,
}

/// Axes of which all values go with all values of the others.
pub type Group = Vec<Axis>;

impl Matrix {
    /// The matrix of the command line, else that of the scene, else the usual one; `open` makes a scene with overrides.
    /// Combinations that the scene refuses are left out, but a value that goes with nothing is a slip.
    ///
    /// # Errors
    /// One sentence on the first axis that the scene refuses.
    pub fn new(vary: &[String], read: &Read, open: impl Fn(&[String]) -> Result<Scene, String>) -> Result<Self, String> {
        let typed = if vary.is_empty() { of_scene(read)? } else { vec![of_options(vary)?] };
        let groups = match typed.is_empty() {
            true => usual::groups(&open(&[])?),
            false => typed.clone(),
        };
        let mut matrix = Self { paths: paths(&groups), settings: Vec::new(), left_out: None };
        if groups.iter().try_fold(0usize, |sum, group| sum.checked_add(count(group)?)).is_none_or(|sum| sum > MOST_SETTINGS) {
            return Err(format!("the matrix has more than {MOST_SETTINGS} settings: vary less"));
        }
        for group in &groups {
            matrix.extend(group, !typed.is_empty(), &open)?;
        }
        match &matrix.left_out {
            Some((_, reason)) if matrix.settings.is_empty() => Err(reason.clone()),
            _ => Ok(matrix),
        }
    }

    fn extend(&mut self, group: &Group, typed: bool, open: impl Fn(&[String]) -> Result<Scene, String>) -> Result<(), String> {
        let (mut taken, mut refused) = (Vec::new(), Vec::new());
        for choice in product(group) {
            match open(&overrides(group, &choice)) {
                Ok(_) => taken.push(choice),
                Err(reason) => refused.push((choice, reason)),
            }
        }
        let held = |k: usize, value: usize| taken.iter().any(|choice| choice[k] == value);
        let slip = |choice: &Vec<usize>| choice.iter().enumerate().any(|(k, &value)| !held(k, value));
        if let (true, Some((choice, reason))) = (typed, refused.iter().find(|(choice, _)| slip(choice))) {
            return Err(at_axis(group, choice, reason));
        }
        for choice in &taken {
            let setting = Setting { shown: shown(&self.paths, group, choice), overrides: overrides(group, choice) };
            if !self.settings.iter().any(|other| other.shown == setting.shown) {
                self.settings.push(setting);
            }
        }
        if let Some((_, reason)) = refused.first() {
            let (before, first) = self.left_out.take().unwrap_or((0, reason.clone()));
            self.left_out = Some((before + refused.len(), first));
        }
        Ok(())
    }
}

/// Of all groups, each once.
fn paths(groups: &[Group]) -> Vec<String> {
    let mut paths: Vec<String> = Vec::new();
    for axis in groups.iter().flatten() {
        if !paths.contains(&axis.path) {
            paths.push(axis.path.clone());
        }
    }
    paths
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

fn of_scene(read: &Read) -> Result<Vec<Group>, String> {
    let Some(groups) = &read.file.study.accuracy else { return Ok(Vec::new()) };
    let group = |(k, group): (usize, &BTreeMap<String, Vec<toml::Value>>)| {
        let place = |path: &str| match groups.one() {
            true => read.source.place(&["study", "accuracy", path]),
            false => read.source.place(&["study", "accuracy", &k.to_string(), path]),
        };
        let axis = |(path, values): (&String, &Vec<toml::Value>)| {
            Axis::new(path, format!("{}: `{path}`", place(path)), values.iter().map(Value::from).collect())
        };
        // What a variant changes comes before what a value does.
        let (variant, others): (Vec<_>, Vec<_>) = group.iter().partition(|(path, _)| *path == VARIANT);
        variant.into_iter().chain(others).map(axis).collect()
    };
    groups.list().iter().enumerate().filter(|(_, group)| !group.is_empty()).map(group).collect()
}

/// Combinations of a group; `None` where they are past counting.
fn count(group: &Group) -> Option<usize> {
    group.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.values.len()))
}

/// Every combination as the index of a value for each axis, the first axis slowest.
fn product(group: &Group) -> Vec<Vec<usize>> {
    let extend = |choices: Vec<Vec<usize>>, axis: &Axis| {
        let with = |choice: &Vec<usize>, value: usize| choice.iter().copied().chain([value]).collect();
        choices.iter().flat_map(|choice| (0..axis.values.len()).map(move |value| with(choice, value))).collect()
    };
    group.iter().fold(vec![Vec::new()], extend)
}

fn values<'a>(group: &'a Group, choice: &[usize]) -> impl Iterator<Item = (&'a Axis, &'a Value)> {
    group.iter().zip(choice.to_vec()).map(|(axis, value)| (axis, &axis.values[value]))
}

fn overrides(group: &Group, choice: &[usize]) -> Vec<String> {
    let own = |(axis, value): (&Axis, &Value)| [format!("{}={}", axis.path, value.typed)].into_iter().chain(value.also.clone());
    values(group, choice).flat_map(own).collect()
}

fn shown(paths: &[String], group: &Group, choice: &[usize]) -> Vec<String> {
    let value = |path: &String| values(group, choice).find(|(axis, _)| axis.path == *path).map(|(_, value)| value.shown.clone());
    paths.iter().map(|path| value(path).unwrap_or_else(|| OWN.into())).collect()
}

/// A refusal with the place where the axis at fault was typed, or else with the values that do not go together.
fn at_axis(group: &Group, choice: &[usize], reason: &str) -> String {
    let own = |axis: &Axis| Some(format!("{}: {}", axis.place, reason.strip_prefix(&format!("--set {}: ", axis.path))?));
    let variant = || group.iter().find(|axis| axis.path == VARIANT && reason.contains("unknown variant"));
    let overrides = || match variant() {
        Some(axis) => format!("{}: {reason}", axis.place),
        None => format!("{reason} (with {})", overrides(group, choice).join(", ")),
    };
    group.iter().find_map(own).unwrap_or_else(overrides)
}
