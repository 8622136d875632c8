//! The tree of a scene's values, each with the place where it was typed, from TOML and to [`File`].

use super::super::file::File;
use super::super::words::{Fault, nearest, one_line, sentence};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, Deserializer};

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
        let Value::Table(entries) = &self.value else {
            return Vec::new();
        };
        entries.get(key).map_or_else(Vec::new, |entry| entry.node.keys())
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
            Value::Literal(text) => match DeValue::parse(text).map(Spanned::into_inner) {
                Ok(DeValue::Datetime(_)) => "a date".to_string(),
                _ => text.clone(),
            },
        }
    }

    pub fn table(&self) -> toml::Table {
        toml::Table::deserialize(Numbered::default().deserializer(self)).unwrap_or_default()
    }
}

/// The values and keys of a scene in the order of the numbers that stand for their byte ranges.
#[derive(Default)]
struct Numbered<'a> {
    sites: Vec<Site<'a>>,
}

struct Site<'a> {
    path: Vec<String>,
    place: &'a Place,
    node: &'a Node,
}

impl<'a> Numbered<'a> {
    fn deserializer(&mut self, root: &'a Node) -> Deserializer<'a> {
        let span = self.span(&[], &root.place, root);
        match &root.value {
            Value::Table(entries) => Deserializer::from(Spanned::new(span, self.table(entries, &mut Vec::new()))),
            _ => Deserializer::from(Spanned::new(span, DeTable::new())),
        }
    }

    fn span(&mut self, path: &[String], place: &'a Place, node: &'a Node) -> Range<usize> {
        let number = self.sites.len();
        self.sites.push(Site { path: path.to_vec(), place, node });
        number..number
    }

    fn table(&mut self, entries: &'a BTreeMap<String, Entry>, path: &mut Vec<String>) -> DeTable<'a> {
        let mut table = DeTable::new();
        for (key, entry) in entries {
            path.push(key.clone());
            let key = Spanned::new(self.span(path, &entry.place, &entry.node), key.as_str().into());
            table.insert(key, self.value(&entry.node, path));
            path.pop();
        }
        table
    }

    fn value(&mut self, node: &'a Node, path: &mut Vec<String>) -> Spanned<DeValue<'a>> {
        let span = self.span(path, &node.place, node);
        let value = match &node.value {
            Value::Table(entries) => DeValue::Table(self.table(entries, path)),
            Value::List(items) => DeValue::Array(self.list(items, path)),
            Value::Text(text) => DeValue::String(text.as_str().into()),
            Value::Literal(text) => match DeValue::parse(text) {
                Ok(value) => value.into_inner(),
                Err(_) => DeValue::String(text.as_str().into()),
            },
        };
        Spanned::new(span, value)
    }

    fn list(&mut self, items: &'a [Node], path: &mut Vec<String>) -> DeArray<'a> {
        let mut list = DeArray::new();
        for (index, item) in items.iter().enumerate() {
            path.push(index.to_string());
            list.push(self.value(item, path));
            path.pop();
        }
        list
    }
}

/// Tables that `[formulation]` has as its own; any other table in it is a named formulation.
const OWN_TABLES: [&str; 2] = ["viscosity", "artificial_stress"];
/// Key under which [`File`] has the named formulations.
const FORMULATIONS: &str = "formulations";

/// The scene with its named formulations beside the plain one, where serde finds them by their type. A table whose name is
/// nearly that of an own one is left to be refused as a slip.
fn formulations_apart(root: &Node) -> Node {
    let mut root = root.clone();
    let Value::Table(tables) = &mut root.value else { return root };
    let Some(Entry { place, node: Node { value: Value::Table(keys), .. } }) = tables.get_mut("formulation") else { return root };
    let named = |key: &str, entry: &Entry| {
        let table = matches!(entry.node.value, Value::Table(_));
        table && !OWN_TABLES.contains(&key) && nearest(key, OWN_TABLES.into_iter()).is_none()
    };
    let (apart, own) = std::mem::take(keys).into_iter().partition::<BTreeMap<_, _>, _>(|(key, entry)| named(key, entry));
    *keys = own;
    if !apart.is_empty() {
        let node = Node { place: place.clone(), value: Value::Table(apart) };
        let entry = Entry { place: place.clone(), node };
        tables.insert(FORMULATIONS.to_string(), entry);
    }
    root
}

pub(super) fn deserialize(root: &Node, name: &str) -> Result<File, String> {
    if root.keys().contains(&FORMULATIONS) {
        return Err(format!("{name}: unknown key `{FORMULATIONS}`: a named formulation is typed as [formulation.NAME]"));
    }
    let root = &formulations_apart(root);
    let mut numbered = Numbered::default();
    let file = File::deserialize(numbered.deserializer(root))
        .map_err(|error| complaint(&numbered.sites[error.span().map_or(0, |span| span.start)], error.message(), name))?;
    let understood = toml::Value::try_from(&file).map_err(|error| format!("{name}: {}", one_line(&error.to_string())))?;
    match ignored(root, &understood, &mut Vec::new()) {
        Some((site, message)) => Err(complaint(&site, &message, name)),
        None => Ok(file),
    }
}

fn complaint(site: &Site, message: &str, name: &str) -> String {
    let word = match &site.node.value {
        Value::Text(word) => Some(word.as_str()),
        _ => None,
    };
    let (found, keys) = (site.node.describe(), site.node.keys());
    let path: Vec<String> = site.path.iter().map(|part| part.replace(FORMULATIONS, "formulation")).collect();
    let fault = Fault { message, path: &path, found, word, keys };
    format!("{}: {}", show(name, site.place), sentence(&fault))
}

/// What serde let pass, in its own words: it takes a list of values for a table and an empty table for a
/// word, and toml drops what a list has too many. Each differs from the file when written again.
fn ignored<'a>(node: &'a Node, understood: &toml::Value, path: &mut Vec<String>) -> Option<(Site<'a>, String)> {
    let fault = |path: &[String], message: String| Some((Site { path: path.to_vec(), place: &node.place, node }, message));
    let inner: Vec<(String, &Node, &toml::Value)> = match (&node.value, understood) {
        (Value::Table(entries), toml::Value::Table(table)) => {
            let pair = |(key, entry): (&String, &'a Entry)| Some((key.clone(), &entry.node, table.get(key)?));
            entries.iter().filter_map(pair).collect()
        }
        (Value::List(items), toml::Value::Array(array)) if items.len() == array.len() => {
            let indices = (0..).map(|index: usize| index.to_string());
            indices.zip(items.iter().zip(array)).map(|(index, (item, value))| (index, item, value)).collect()
        }
        (Value::List(items), toml::Value::Array(array)) => {
            return fault(path, format!("invalid length {}, expected an array of length {}", items.len(), array.len()));
        }
        (Value::List(_), toml::Value::Table(_)) => {
            return fault(path, "invalid type: list, expected struct".to_string());
        }
        (Value::Table(_), toml::Value::String(_)) => {
            return fault(path, "wanted string or table".to_string());
        }
        _ => Vec::new(),
    };
    inner.into_iter().find_map(|(key, node, understood)| {
        path.push(key);
        let found = ignored(node, understood, path);
        path.pop();
        found
    })
}
