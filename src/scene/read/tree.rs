//! The tree of a scene's values, each with the place where it was typed, from TOML and back.

use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// As the value of a variant's key or of an override: the scene shall be without this key.
pub(super) const NONE: &str = "none";

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    Line(usize),
    /// The path of an override as typed.
    Override(String),
}

#[derive(Debug, Clone)]
pub(super) struct Node {
    pub place: Place,
    pub value: Value,
}

#[derive(Debug, Clone)]
pub(super) enum Value {
    Table(BTreeMap<String, Entry>),
    List(Vec<Node>),
    Text(String),
    /// A number, truth or date as TOML: toml's own number type cannot outlive the text.
    Literal(String),
}

/// A key and its value.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub place: Place,
    pub node: Node,
}

pub(super) type Lines<'a> = &'a dyn Fn(Range<usize>) -> Place;

pub(super) fn show(name: &str, place: &Place) -> String {
    match place {
        Place::Line(line) => format!("{name}:{line}"),
        Place::Override(path) => format!("--set {path}"),
    }
}

pub(super) fn entries(table: DeTable<'_>, line: Lines) -> BTreeMap<String, Entry> {
    let entry = |(key, value): (Spanned<_>, _)| {
        let entry = Entry { place: line(key.span()), node: node(value, line) };
        (std::borrow::Cow::into_owned(key.into_inner()), entry)
    };
    table.into_iter().map(entry).collect()
}

pub(super) fn node(value: Spanned<DeValue<'_>>, line: Lines) -> Node {
    let place = line(value.span());
    let value = match value.into_inner() {
        DeValue::Table(table) => Value::Table(entries(table, line)),
        DeValue::Array(items) => Value::List(items.into_iter().map(|item| node(item, line)).collect()),
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(number) => Value::Literal(number.to_string()),
        DeValue::Float(number) => Value::Literal(number.to_string()),
        DeValue::Boolean(truth) => Value::Literal(truth.to_string()),
        DeValue::Datetime(date) => Value::Literal(date.to_string()),
    };
    Node { place, value }
}

/// The index of an element of a list, given as such or by its `name`.
pub(super) fn position(items: &[Node], part: &str) -> Option<usize> {
    let by_name = items.iter().position(|item| item.name() == Some(part));
    by_name.or_else(|| part.parse().ok().filter(|index| *index < items.len()))
}

impl Node {
    pub fn name(&self) -> Option<&str> {
        let Value::Table(entries) = &self.value else {
            return None;
        };
        match &entries.get("name")?.node.value {
            Value::Text(name) => Some(name),
            _ => None,
        }
    }

    /// The keys of the table under a key of this one.
    pub fn names(&self, key: &str) -> Vec<&str> {
        self.under(key).map_or_else(Vec::new, Node::keys)
    }

    /// What lies under a key of this table.
    pub fn under(&self, key: &str) -> Option<&Node> {
        let Value::Table(entries) = &self.value else { return None };
        entries.get(key).map(|entry| &entry.node)
    }

    pub fn keys(&self) -> Vec<&str> {
        match &self.value {
            Value::Table(entries) => entries.keys().map(String::as_str).collect(),
            _ => Vec::new(),
        }
    }

    pub fn is_none(&self) -> bool {
        matches!(&self.value, Value::Text(word) if word == NONE)
    }

    /// What to merge this into where there is nothing: an empty table, so that inner keys that are "none"
    /// fall away, or the value itself.
    pub fn hollow(&self) -> Node {
        match &self.value {
            Value::Table(_) => Node { place: self.place.clone(), value: Value::Table(BTreeMap::new()) },
            _ => self.clone(),
        }
    }

    /// The scene with only what is expected of this variant, as if it had been typed so.
    pub fn expecting(&self, variant: Option<&str>) -> Node {
        let mut scene = self.clone();
        if let Value::Table(tables) = &mut scene.value
            && let Some(Value::Table(expected)) = tables.get_mut("expect").map(|entry| &mut entry.node.value)
        {
            expected.retain(|_, entry| match &mut entry.node.value {
                Value::Table(keys) => keys.remove("variant").is_none_or(|named| named.node.is_text(variant.unwrap_or(NONE))),
                _ => true,
            });
        }
        scene
    }

    fn is_text(&self, wanted: &str) -> bool {
        matches!(&self.value, Value::Text(text) if text == wanted)
    }

    /// What the value is, for "found ...".
    pub fn describe(&self) -> String {
        match &self.value {
            Value::Table(_) => "a table".to_string(),
            Value::List(_) => "a list".to_string(),
            Value::Text(_) => "a string".to_string(),
            Value::Literal(text) => match text.parse() {
                Ok(toml::Value::Datetime(_)) => "a date".to_string(),
                _ => text.clone(),
            },
        }
    }

    pub fn table(&self) -> toml::Table {
        let Value::Table(entries) = &self.value else {
            return toml::Table::new();
        };
        entries.iter().map(|(key, entry)| (key.clone(), entry.node.toml())).collect()
    }

    fn toml(&self) -> toml::Value {
        match &self.value {
            Value::Table(_) => toml::Value::Table(self.table()),
            Value::List(items) => toml::Value::Array(items.iter().map(Node::toml).collect()),
            Value::Text(text) => toml::Value::String(text.clone()),
            // TOML has no whole number as large as some that pass for a real one.
            Value::Literal(text) => text.parse().unwrap_or_else(|_| toml::Value::Float(text.parse().unwrap_or(f64::NAN))),
        }
    }
}
