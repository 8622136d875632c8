//! Pieces of a scene that it may do without, each as the overrides that take it away.

use crate::scene::file::{File, Observe};

/// What a piece is to the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sort {
    /// Physics or numerics that the scene names: without it the model is smaller.
    Named,
    /// The same model, cheaper: coarser, shorter, of fewer dimensions or bodies.
    Reduced,
}

/// Something that can be taken away.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// "viscosity", "spacing 0.1 instead of 0.05".
    pub name: String,
    pub sort: Sort,
    /// `path=value`; `none` removes a key.
    pub overrides: Vec<String>,
    /// Why it cannot be tried.
    pub refused: Option<String>,
    /// The new duration: what is judged beyond it has no number.
    pub ends: Option<f64>,
    /// Length of the axis that falls away: sums over particles are then those of a unit of it.
    pub width: Option<f64>,
}

impl Piece {
    pub fn new(name: impl Into<String>, sort: Sort, overrides: Vec<String>) -> Self {
        let overrides = joined(overrides.iter()).unwrap_or(overrides);
        Self { name: name.into(), sort, overrides, refused: None, ends: None, width: None }
    }

    pub fn refused(name: impl Into<String>, sort: Sort, reason: impl Into<String>) -> Self {
        Self { refused: Some(reason.into()), ..Self::new(name, sort, Vec::new()) }
    }

    /// Several pieces as one; `None` where two of them set a key to different values.
    pub fn joined(pieces: &[&Piece]) -> Option<Self> {
        let names: Vec<&str> = pieces.iter().map(|piece| piece.name.as_str()).collect();
        let overrides = joined(pieces.iter().flat_map(|piece| &piece.overrides))?;
        Some(Self {
            ends: pieces.iter().find_map(|piece| piece.ends),
            width: pieces.iter().find_map(|piece| piece.width),
            ..Self::new(names.join(" + "), Sort::Named, overrides)
        })
    }
}

fn split(text: &str) -> (&str, &str) {
    text.split_once('=').unwrap_or((text, ""))
}

/// Overrides in an order in which each still finds its path: values first, then what is removed, elements of lists
/// from the last to the first, since they go by index. What lies below something removed is left out.
fn joined<'a>(all: impl Iterator<Item = &'a String>) -> Option<Vec<String>> {
    let mut list: Vec<&String> = Vec::new();
    for text in all {
        let (path, value) = split(text);
        match list.iter().map(|other| split(other)).find(|(other, _)| *other == path) {
            Some((_, other)) if other != value => return None,
            Some(_) => {}
            None => list.push(text),
        }
    }
    let gone: Vec<String> = list.iter().filter(|text| split(text).1 == NONE).map(|text| format!("{}.", split(text).0)).collect();
    list.retain(|text| !gone.iter().any(|above| text.starts_with(above)));
    let (mut removed, mut kept): (Vec<&String>, Vec<&String>) = list.into_iter().partition(|text| split(text).1 == NONE);
    let index = |text: &String| split(text).0.rsplit('.').next().and_then(|last| last.parse::<usize>().ok());
    removed.sort_by_key(|text| std::cmp::Reverse(index(text)));
    kept.extend(removed);
    Some(kept.into_iter().cloned().collect())
}

const NONE: &str = "none";

/// `path=none`
pub fn without(path: &str) -> String {
    format!("{path}={NONE}")
}

/// Overrides that take away observables, what is found from them, and what is expected of either.
pub fn without_observables(file: &File, gone: impl Fn(&Observe) -> bool) -> Vec<String> {
    let mut names: Vec<&String> = file.observe.iter().filter(|(_, typed)| gone(typed)).map(|(name, _)| name).collect();
    let mut next = 0;
    while let Some(name) = names.get(next).copied() {
        let found_from = |typed: &Observe| typed.of.as_ref() == Some(name) || typed.over.as_ref() == Some(name);
        let more = file.observe.iter().filter(|(other, typed)| found_from(typed) && !names.contains(other));
        let more: Vec<&String> = more.map(|(other, _)| other).collect();
        names.extend(more);
        next += 1;
    }
    let expected = names.iter().filter(|name| file.expect.contains_key(**name)).map(|name| without(&format!("expect.{name}")));
    names.iter().map(|name| without(&format!("observe.{name}"))).chain(expected).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(overrides: &[&str]) -> Piece {
        Piece::new("x", Sort::Named, overrides.iter().map(|text| text.to_string()).collect())
    }

    #[test]
    fn joined_overrides_still_find_their_paths() {
        let (a, b) = (piece(&["contact.0=none", "expect.e=none"]), piece(&["contact.2.gap.friction=0", "contact.1=none"]));
        let c = piece(&["contact.0.kernel=0", "expect.e=none", "spacing=2"]);
        let all = Piece::joined(&[&a, &b, &c]).unwrap();
        assert_eq!(all.overrides, ["contact.2.gap.friction=0", "spacing=2", "contact.1=none", "contact.0=none", "expect.e=none"]);
    }

    #[test]
    fn elements_of_a_list_go_from_the_last_to_the_first() {
        assert_eq!(
            piece(&["contact.0=none", "body.b=none", "contact.2=none"]).overrides,
            ["contact.2=none", "contact.0=none", "body.b=none"]
        );
    }

    #[test]
    fn what_contradicts_is_not_joined() {
        assert!(Piece::joined(&[&piece(&["a=1"]), &piece(&["a=2"])]).is_none());
        assert!(Piece::joined(&[&piece(&["a=1"]), &piece(&["a=1", "b=2"])]).is_some());
    }
}
