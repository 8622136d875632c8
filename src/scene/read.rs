//! From a scene file to [`File`]: the TOML with one of its variants merged over it and single values
//! overridden.
//!
//! Every error is one sentence that begins with the place of the mistake. For that each value carries the
//! line that it was typed on; while serde reads the tree, the byte ranges that it reports are numbers of
//! the values and keys instead.

use super::file::File;
use super::words::{Fault, is_choice, list, one_line, quoted, sentence};
pub use super::words::{hint, nearest};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry::{Occupied, Vacant};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, Deserializer};

/// As the value of a variant's key or of an override: the scene shall be without this key.
const NONE: &str = "none";

/// Tables whose keys are names that the scene chooses.
const NAMED: [&str; 3] = ["material", "observe", "expect"];

/// A scene as read.
#[derive(Debug, Clone)]
pub struct Read {
    pub file: File,
    pub source: Source,
    pub variant: Option<String>,
    /// The merged scene as TOML, without its variants.
    pub resolved_text: String,
    document: Document,
}

/// Where each value of a scene was typed.
#[derive(Debug, Clone)]
pub struct Source {
    name: String,
    root: Node,
}

/// A parsed file before anything is merged.
#[derive(Debug, Clone)]
struct Document {
    name: String,
    root: Node,
    variants: BTreeMap<String, Entry>,
}

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Line(usize),
    /// The path of an override as typed.
    Override(String),
}

#[derive(Debug, Clone)]
struct Node {
    place: Place,
    value: Value,
}

#[derive(Debug, Clone)]
enum Value {
    Table(BTreeMap<String, Entry>),
    List(Vec<Node>),
    Text(String),
    /// A number, truth or date as TOML: toml's own number type cannot outlive the text.
    Literal(String),
}

/// A key and its value.
#[derive(Debug, Clone)]
struct Entry {
    place: Place,
    node: Node,
}

/// A key that a variant or an override took away.
struct Removal {
    path: Vec<String>,
    place: Place,
    existed: bool,
}

/// Reads a scene, merges a variant over it and applies overrides `path=value`.
///
/// # Errors
/// One sentence that begins with the file and line, or with the override, at fault.
pub fn read(path: &Path, variant: Option<&str>, overrides: &[String]) -> Result<Read, String> {
    read_text(&text_of(path)?, &path.display().to_string(), variant, overrides)
}

/// [`read`] of a text; `name` stands for the file in errors.
///
/// # Errors
/// As [`read`].
pub fn read_text(text: &str, name: &str, variant: Option<&str>, overrides: &[String]) -> Result<Read, String> {
    let document = Document::parse(text, name)?;
    let (root, mut file) = document.assemble(variant, overrides)?;
    let resolved_text =
        toml::to_string(&root.expecting(variant).table()).map_err(|error| format!("{name}: {}", one_line(&error.to_string())))?;
    file.variant = document.variants.iter().map(|(name, entry)| (name.clone(), entry.node.table())).collect();
    let source = Source { name: name.to_string(), root };
    Ok(Read { file, source, variant: variant.map(str::to_string), resolved_text, document })
}

/// Names of the variants of a scene, in the order of the file.
///
/// # Errors
/// As [`read`], where the file is not TOML.
pub fn variants(path: &Path) -> Result<Vec<String>, String> {
    let document = Document::parse(&text_of(path)?, &path.display().to_string())?;
    let mut names: Vec<_> = document.variants.iter().collect();
    names.sort_by_key(|(_, entry)| &entry.place);
    Ok(names.into_iter().map(|(name, _)| name.clone()).collect())
}

impl Read {
    /// Merges and reads every variant of the scene, so that a mistake in one shows before it is chosen.
    ///
    /// # Errors
    /// As [`read`], the first one found; or where an expectation is for a variant that does not exist.
    pub fn check_variants(&self) -> Result<(), String> {
        let names: Vec<&str> = self.document.variants.keys().map(String::as_str).collect();
        for name in &names {
            self.document.assemble(Some(name), &[])?;
        }
        for (name, expect) in &self.file.expect {
            if let Some(variant) = expect.variant.as_deref().filter(|variant| *variant != NONE && !names.contains(variant)) {
                let place = self.source.place(&["expect", name, "variant"]);
                return Err(format!("{place}: unknown variant `{variant}` in `expect.{name}`{}", hint(variant, &names)));
            }
        }
        Ok(())
    }
}

impl Source {
    /// "scenes/rings.toml:12" of the value at a path of keys and indices, or of its nearest enclosing
    /// table; "--set velocity" for an override.
    pub fn place(&self, path: &[&str]) -> String {
        let mut node = &self.root;
        for part in path {
            let inner = match &node.value {
                Value::Table(entries) => entries.get(*part).map(|entry| &entry.node),
                Value::List(items) => position(items, part).map(|index| &items[index]),
                Value::Text(_) | Value::Literal(_) => None,
            };
            match inner {
                Some(inner) => node = inner,
                None => break,
            }
        }
        show(&self.name, &node.place)
    }
}

fn show(name: &str, place: &Place) -> String {
    match place {
        Place::Line(line) => format!("{name}:{line}"),
        Place::Override(path) => format!("--set {path}"),
    }
}

fn text_of(path: &Path) -> Result<String, String> {
    let name = path.display();
    let bytes = std::fs::read(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => format!("{name}: no such file"),
        std::io::ErrorKind::IsADirectory => format!("{name}: a folder, not a scene file"),
        _ => format!("{name}: cannot be read: {error}"),
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let line = line_of(error.as_bytes(), error.utf8_error().valid_up_to());
        format!("{name}:{line}: not UTF-8 text")
    })
}

/// The line of a byte, counted from 1; the last line for the end of the text.
fn line_of(text: &[u8], byte: usize) -> usize {
    let end = byte.min(text.len().saturating_sub(1));
    1 + text[..end].iter().filter(|byte| **byte == b'\n').count()
}

impl Document {
    fn parse(text: &str, name: &str) -> Result<Self, String> {
        let table = DeTable::parse(text).map_err(|error| syntax_error(text, name, &error))?;
        let newlines: Vec<usize> = text.match_indices('\n').map(|(byte, _)| byte).collect();
        let line = |span: Range<usize>| Place::Line(1 + newlines.partition_point(|newline| *newline < span.start));
        let mut entries = entries(table.into_inner(), &line);
        let variants = match entries.remove("variant") {
            None => BTreeMap::new(),
            Some(Entry { node: Node { value: Value::Table(variants), .. }, .. }) => variants,
            Some(entry) => {
                let found = entry.node.describe();
                return Err(format!("{}: `variant` must be a table, found {found}", show(name, &entry.place)));
            }
        };
        let root = Node { place: Place::Line(1), value: Value::Table(entries) };
        Ok(Self { name: name.to_string(), root, variants })
    }

    /// The scene with a variant and overrides, as typed and as read.
    fn assemble(&self, variant: Option<&str>, overrides: &[String]) -> Result<(Node, File), String> {
        let mut root = self.root.clone();
        let mut removals = Vec::new();
        if let Some(variant) = variant {
            let change = self.variant(variant)?;
            merge(&mut root, change, &mut Vec::new(), &mut removals);
        }
        for text in overrides {
            apply(&mut root, text, &mut removals)?;
        }
        let file = deserialize(&root, &self.name)?;
        self.check_removals(&root, &removals)?;
        Ok((root, file))
    }

    fn variant(&self, name: &str) -> Result<Node, String> {
        let names: Vec<&str> = self.variants.keys().map(String::as_str).collect();
        let Some(entry) = self.variants.get(name) else {
            return Err(match nearest(name, names.iter().copied()) {
                Some(near) => format!("{}: unknown variant `{name}`, did you mean `{near}`?", self.name),
                None if names.is_empty() => format!("{}: unknown variant `{name}`, the scene has none", self.name),
                None => format!("{}: unknown variant `{name}`, expected {}", self.name, list(&names, "or")),
            });
        };
        let place = show(&self.name, &entry.place);
        let Value::Table(entries) = &entry.node.value else {
            return Err(format!("{place}: `variant.{name}` must be a table, found {}", entry.node.describe()));
        };
        match entries.get("variant") {
            Some(inner) => Err(format!("{}: a variant cannot hold variants", show(&self.name, &inner.place))),
            None => Ok(entry.node.clone()),
        }
    }

    /// A removed key is gone before serde could find it unknown, so any value takes its place for once.
    fn check_removals(&self, root: &Node, removals: &[Removal]) -> Result<(), String> {
        for removal in removals {
            let place = show(&self.name, &removal.place);
            let unknown = format!("{place}: unknown key `{}`", removal.path.last().map_or("", String::as_str));
            if let ([table, name], false) = (removal.path.as_slice(), removal.existed)
                && NAMED.contains(&table.as_str())
            {
                return Err(format!("{place}: there is no `{table}.{name}` to remove{}", hint(name, &root.names(table))));
            }
            let mut probe = root.clone();
            let value = Some(Node { place: removal.place.clone(), value: Value::Literal("true".to_string()) });
            if assign(&mut probe, &removal.path, value, &removal.place, &mut Vec::new()).is_ok()
                && let Err(error) = deserialize(&probe, &self.name)
                && error.starts_with(&unknown)
            {
                return Err(error);
            }
        }
        Ok(())
    }
}

fn syntax_error(text: &str, name: &str, error: &toml::de::Error) -> String {
    let span = error.span().unwrap_or(0..0);
    let message = one_line(error.message());
    let message = match text.get(span.clone()) {
        Some(key) if message == "duplicate key" => format!("duplicate key `{key}`"),
        _ if message.starts_with("string values must be quoted") || message.starts_with("invalid boolean") => {
            "not valid TOML: after `=` comes one value, text in quotes".to_string()
        }
        _ => format!("not valid TOML: {message}"),
    };
    format!("{name}:{}: {message}", line_of(text.as_bytes(), span.start))
}

type Lines<'a> = &'a dyn Fn(Range<usize>) -> Place;

fn entries(table: DeTable<'_>, line: Lines) -> BTreeMap<String, Entry> {
    let entry = |(key, value): (Spanned<_>, _)| {
        let entry = Entry { place: line(key.span()), node: node(value, line) };
        (std::borrow::Cow::into_owned(key.into_inner()), entry)
    };
    table.into_iter().map(entry).collect()
}

fn node(value: Spanned<DeValue<'_>>, line: Lines) -> Node {
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

/// Merges `change` over `base`; `path` is the place of both in the scene.
fn merge(base: &mut Node, change: Node, path: &mut Vec<String>, removals: &mut Vec<Removal>) {
    let replaces = path.last().is_some_and(|key| is_choice(key)) && names_another(base, &change);
    match (&mut base.value, change.value) {
        (Value::Table(entries), Value::Table(changes)) if !replaces => merge_tables(entries, changes, path, removals),
        (Value::List(items), Value::List(changes)) if all_named(items) && all_named(&changes) => {
            merge_lists(items, changes, path, removals);
        }
        (_, value) => *base = Node { place: change.place, value },
    }
}

fn merge_tables(
    entries: &mut BTreeMap<String, Entry>,
    changes: BTreeMap<String, Entry>,
    path: &mut Vec<String>,
    removals: &mut Vec<Removal>,
) {
    for (key, change) in changes {
        path.push(key.clone());
        if change.node.is_none() {
            let existed = entries.remove(&key).is_some();
            removals.push(Removal { path: path.clone(), place: change.place, existed });
        } else {
            let entry = match entries.entry(key) {
                Occupied(entry) => entry.into_mut(),
                Vacant(entry) => entry.insert(Entry { place: change.place, node: change.node.hollow() }),
            };
            merge(&mut entry.node, change.node, path, removals);
        }
        path.pop();
    }
}

/// Element by name; those of a new name go to the end.
fn merge_lists(items: &mut Vec<Node>, changes: Vec<Node>, path: &mut Vec<String>, removals: &mut Vec<Removal>) {
    for change in changes {
        let name = change.name().unwrap_or_default();
        let index = items.iter().position(|item| item.name() == Some(name)).unwrap_or_else(|| {
            items.push(change.hollow());
            items.len() - 1
        });
        path.push(index.to_string());
        merge(&mut items[index], change, path, removals);
        path.pop();
    }
}

fn names_another(base: &Node, change: &Node) -> bool {
    match (&base.value, &change.value) {
        (Value::Table(old), Value::Table(new)) => !old.keys().eq(new.keys()),
        _ => false,
    }
}

fn all_named(items: &[Node]) -> bool {
    items.iter().all(|item| item.name().is_some())
}

/// The index of an element of a list, given as such or by its `name`.
fn position(items: &[Node], part: &str) -> Option<usize> {
    let by_name = items.iter().position(|item| item.name() == Some(part));
    by_name.or_else(|| part.parse().ok().filter(|index| *index < items.len()))
}

/// Applies one override `path=value`.
fn apply(root: &mut Node, text: &str, removals: &mut Vec<Removal>) -> Result<(), String> {
    let (typed, value) = match text.split_once('=') {
        Some((path, value)) => (path.trim(), value.trim()),
        None => return Err(format!("--set {text}: must be `path=value`, found no `=`")),
    };
    let fail = |message: String| format!("--set {}: {message}", if typed.is_empty() { text } else { typed });
    let path: Vec<String> = typed.split('.').map(|part| part.trim().to_string()).collect();
    if path.iter().any(String::is_empty) {
        return Err(fail("must be a path of keys such as `formulation.xsph`".to_string()));
    }
    if path[0] == "variant" {
        return Err(fail("variants are chosen, not set".to_string()));
    }
    refuse_new_name(root, &path).map_err(fail)?;
    let place = Place::Override(typed.to_string());
    let node = override_value(value, &place).map_err(fail)?;
    let removes = node.is_none();
    let mut walked = Vec::new();
    let existed = assign(root, &path, Some(node).filter(|_| !removes), &place, &mut walked).map_err(fail)?;
    // A list element that was there was certainly no misspelt key.
    let is_key = walked.last().is_some_and(|part| part.parse::<usize>().is_err());
    if removes && is_key {
        removals.push(Removal { path: walked, place, existed });
    }
    Ok(())
}

/// A key below a name that the scene lacks: the name is a slip rather than one more material.
fn refuse_new_name(root: &Node, path: &[String]) -> Result<(), String> {
    if let [table, name, _, ..] = path
        && NAMED.contains(&table.as_str())
        && !root.names(table).contains(&name.as_str())
    {
        return Err(format!("there is no `{table}.{name}`{}", hint(name, &root.names(table))));
    }
    Ok(())
}

/// A TOML value; what is none and has no look of a list, table or quoted string is a bare word.
fn override_value(text: &str, place: &Place) -> Result<Node, String> {
    if text.is_empty() {
        return Err("has no value after the `=`".to_string());
    }
    match DeValue::parse(text) {
        Ok(value) => Ok(node(value, &|_| place.clone())),
        Err(error) if text.starts_with(['[', '{', '"', '\'']) => Err(format!("not a TOML value: {}", one_line(error.message()))),
        Err(_) => Ok(Node { place: place.clone(), value: Value::Text(text.to_string()) }),
    }
}

/// Puts a value at a path, or takes away what is there, and says whether something was; `walked` becomes
/// the path with indices instead of names.
fn assign(
    node: &mut Node,
    path: &[String],
    value: Option<Node>,
    place: &Place,
    walked: &mut Vec<String>,
) -> Result<bool, String> {
    let Some((part, rest)) = path.split_first() else {
        return Ok(false);
    };
    let found = node.describe();
    let inner = match &mut node.value {
        Value::Table(entries) => {
            walked.push(part.clone());
            if rest.is_empty() {
                return Ok(put(entries, part, value, place));
            }
            let empty = || Node { place: place.clone(), value: Value::Table(BTreeMap::new()) };
            &mut entries.entry(part.clone()).or_insert_with(|| Entry { place: place.clone(), node: empty() }).node
        }
        Value::List(items) => {
            let index = position(items, part).ok_or_else(|| no_element(items, walked, part))?;
            walked.push(index.to_string());
            match (rest.is_empty(), value.is_some()) {
                (true, true) => value.into_iter().for_each(|value| items[index] = value),
                (true, false) => drop(items.remove(index)),
                (false, _) => return assign(&mut items[index], rest, value, place, walked),
            }
            return Ok(true);
        }
        Value::Text(_) | Value::Literal(_) => {
            return Err(format!("unknown path, {} is {found} and has no `{part}`", quoted(walked)));
        }
    };
    assign(inner, rest, value, place, walked)
}

fn put(entries: &mut BTreeMap<String, Entry>, key: &str, value: Option<Node>, place: &Place) -> bool {
    match value {
        Some(node) => entries.insert(key.to_string(), Entry { place: place.clone(), node }).is_some(),
        None => entries.remove(key).is_some(),
    }
}

fn no_element(items: &[Node], walked: &[String], part: &str) -> String {
    let names: Vec<&str> = items.iter().filter_map(Node::name).collect();
    let list = quoted(walked);
    match part.parse::<usize>() {
        Ok(_) => format!("{list} has no element `{part}`, there are {}, counted from 0", items.len()),
        Err(_) if names.is_empty() => {
            format!("{list} is a list, its elements go by index, not `{part}`")
        }
        Err(_) => format!("{list} has no element `{part}`{}", hint(part, &names)),
    }
}

impl Node {
    fn name(&self) -> Option<&str> {
        let Value::Table(entries) = &self.value else {
            return None;
        };
        match &entries.get("name")?.node.value {
            Value::Text(name) => Some(name),
            _ => None,
        }
    }

    /// The keys of the table under a key of this one.
    fn names(&self, key: &str) -> Vec<&str> {
        let Value::Table(entries) = &self.value else {
            return Vec::new();
        };
        entries.get(key).map_or_else(Vec::new, |entry| entry.node.keys())
    }

    fn keys(&self) -> Vec<&str> {
        match &self.value {
            Value::Table(entries) => entries.keys().map(String::as_str).collect(),
            _ => Vec::new(),
        }
    }

    fn is_none(&self) -> bool {
        matches!(&self.value, Value::Text(word) if word == NONE)
    }

    /// What to merge this into where there is nothing: an empty table, so that inner keys that are "none"
    /// fall away, or the value itself.
    fn hollow(&self) -> Node {
        match &self.value {
            Value::Table(_) => Node { place: self.place.clone(), value: Value::Table(BTreeMap::new()) },
            _ => self.clone(),
        }
    }

    /// The scene with only what is expected of this variant, as if it had been typed so.
    fn expecting(&self, variant: Option<&str>) -> Node {
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
    fn describe(&self) -> String {
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

    fn table(&self) -> toml::Table {
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

fn deserialize(root: &Node, name: &str) -> Result<File, String> {
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
    let fault = Fault { message, path: &site.path, found, word, keys };
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

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"title = "Two rings"
dimension = 2
spacing = 1
duration = 2

[[body]]
name = "left"
shape = { ring = { center = [0, 0], inner = 30, outer = 35 } }
material = "steel"
velocity = [1, 0]

[[body]]
name = "right"
shape.disc = { center = [80, 0], radius = 10 }
material = "steel"

[material.steel]
density = 1

[formulation]
smoothing = "gaussian"

[formulation.artificial_stress]
epsilon = 0.3

[[boundary]]
select = { body = "left" }
fixed = true

[[contact]]
between = ["left", "right"]
kernel = 0.5

[time]
integrator = "rk4"

[expect.energy]
norm = "max"

[variant.plain]
formulation.artificial_stress = "none"
formulation.viscosity = { alpha = 1, beta = "none" }

[variant.other]
spacing = 0.5

[[variant.other.body]]
name = "right"
shape.block = { min = [70, -10], max = [90, 10] }

[[variant.other.body]]
name = "third"
shape.disc = { center = [0, 0], radius = 5 }
material = "steel"
"#;

    fn set(texts: &[&str]) -> Result<Read, String> {
        let texts: Vec<String> = texts.iter().map(|text| text.to_string()).collect();
        read_text(SCENE, "s.toml", None, &texts)
    }

    fn variant(name: &str) -> Read {
        read_text(SCENE, "s.toml", Some(name), &[]).unwrap()
    }

    /// The error after a change to the scene.
    fn complaint(from: &str, to: &str) -> String {
        assert!(SCENE.contains(from), "{from}");
        match read_text(&SCENE.replacen(from, to, 1), "s.toml", None, &[]) {
            Ok(_) => panic!("no error: {to}"),
            Err(error) => error,
        }
    }

    #[track_caller]
    fn assert_complaints(cases: &[(&str, &str, &str)]) {
        for (from, to, expected) in cases {
            assert_eq!(complaint(from, to), format!("s.toml:{expected}"), "{to}");
        }
    }

    #[test]
    fn text_that_is_no_toml() {
        let quotes = "4: not valid TOML: after `=` comes one value, text in quotes";
        assert_complaints(&[
            ("duration = 2", "duration = ", quotes),
            ("duration = 2", "duration = two", quotes),
            ("duration = 2", "duration = 2 3", quotes),
            ("duration = 2", "duration = \"2", "4: not valid TOML: invalid basic string, expected `\"`"),
            ("duration = 2", "duration = 2\nduration = 3", "5: duplicate key `duration`"),
            ("[formulation]", "[formulation", "20: not valid TOML: unclosed table, expected `]`"),
        ]);
    }

    #[test]
    fn unknown_keys_and_words() {
        assert_complaints(&[
            ("duration = 2", "durration = 2", "4: unknown key `durration`, did you mean `duration`?"),
            ("smoothing =", "smothing =", "21: unknown key `smothing`, did you mean `smoothing`?"),
            ("outer", "outr", "8: unknown key `outr`, did you mean `outer`?"),
            (
                "norm =",
                "no =",
                "38: unknown key `no` in `expect.energy`, expected `value`, `tolerance`, \
              `relative`, `reference`, `columns`, `norm`, `between`, `because`, `statistic`, `source` or `variant`",
            ),
            (
                "norm =",
                "dimension = 2 #",
                "38: unknown key `dimension` in `expect.energy`, it belongs at the top \
              of the scene, before all tables",
            ),
            ("gaussian", "gausian", "21: unknown word `gausian` for `formulation.smoothing`, did you mean `gaussian`?"),
            ("gaussian", "cubic", "21: unknown word `cubic` for `formulation.smoothing`, did you mean `cubic_spline`?"),
            ("rk4", "rk5", "35: unknown word `rk5` for `time.integrator`, expected `leapfrog`, `rk2`, `ssp_rk3` or `rk4`"),
            ("{ ring", "{ rng", "8: unknown word `rng` for `body.0.shape`, did you mean `ring`?"),
            ("dimension = 2", "dimension = 2\nunits = \"si\"", "3: unknown word `si` for `units`, did you mean `SI`?"),
        ]);
    }

    #[test]
    fn missing_keys() {
        assert_complaints(&[
            ("duration = 2", "", "1: missing key `duration` at the top of the scene"),
            (", outer = 35", "", "8: missing key `outer` in `body.0.shape.ring`"),
            ("shape.disc = { center = [80, 0], radius = 10 }", "", "12: missing key `shape` in `body.1`"),
            ("density = 1", "", "17: missing key `density` in `material.steel`"),
        ]);
    }

    #[test]
    fn wrong_types() {
        let motion = "10: `body.0.motion` must be a table such as `{ wave = { amplitude = [1], wave_vector = [2] } }`, \
                      found a string";
        let velocity = "28: `boundary.0.velocity` must be a list of numbers and \"free\", one for each axis";
        let fixed = "28: `boundary.0.fixed` must be true, false or a list of them, one for each axis";
        assert_complaints(&[
            ("title = \"Two rings\"", "title = 3", "1: `title` must be a string, found 3"),
            ("duration = 2", "duration = \"long\"", "4: `duration` must be a number, found a string"),
            ("duration = 2", "duration = 2024-01-01", "4: `duration` must be a number, found a date"),
            ("duration = 2", "duration = 1e999", "4: `duration` is too large a number"),
            ("dimension = 2", "dimension = 2.5", "2: `dimension` must be a whole number, 0 or more, found 2.5"),
            ("[1, 0]", "\"fast\"", "10: `body.0.velocity` must be a list of numbers, found a string"),
            ("[1, 0]", "[1, \"x\"]", "10: `body.0.velocity.1` must be a number, found a string"),
            ("velocity = [1, 0]", "motion = \"wave\"", motion),
            ("{ ring = {", "{ disc = 1, ring = {", "8: `body.0.shape` must have exactly one key, found `disc` and `ring`"),
            ("\"gaussian\"", "3", "21: `formulation.smoothing` must be a word, found 3"),
            ("fixed = true", "fixed = 3", &format!("{fixed}, found 3")),
            ("fixed = true", "fixed = [true, 3]", fixed),
            ("fixed = true", "velocity = [1, \"fre\"]", velocity),
            (
                "[\"left\", \"right\"]",
                "[\"left\"]",
                "31: `contact.0.between` must be a list of the names of 2 bodies, found a list of 1",
            ),
            ("[[contact]]", "[contact]", "30: `contact` must be a list of tables, each under `[[contact]]`, found a table"),
            ("norm = \"max\"", "columns = 1", "38: `expect.energy.columns` must be a list of 2 strings, found 1"),
            ("[variant.plain]", "[[variant]]", "40: `variant` must be a table, found a list"),
        ]);
    }

    #[test]
    fn what_serde_would_let_pass() {
        let stress = "10: `body.0.deviatoric_stress` must be a list of 6 numbers, found a list of 7";
        assert_complaints(&[
            ("velocity = [1, 0]", "deviatoric_stress = [1, 2, 3, 4, 5, 6, 7]", stress),
            (
                "{ center = [0, 0], inner = 30, outer = 35 }",
                "[[0], 30, 35]",
                "8: `body.0.shape.ring` must be a table, found a list",
            ),
            ("\"gaussian\"", "{ gaussian = {} }", "21: `formulation.smoothing` must be a word, found a table"),
            ("smoothing = \"gaussian\"", "viscosity = 2024-01-01", "21: `formulation.viscosity` must be a table, found a date"),
            ("[time]", "[[time]]", "35: `time` must be a table, found a list"),
        ]);
    }

    #[test]
    fn bad_overrides() {
        let cases = [
            ("velocity", "velocity: must be `path=value`, found no `=`"),
            ("a..b=3", "a..b: must be a path of keys such as `formulation.xsph`"),
            ("spacing=", "spacing: has no value after the `=`"),
            ("spacing=wide", "spacing: `spacing` must be a number, found a string"),
            ("spacing=[1", "spacing: not a TOML value: unclosed array, expected `]`"),
            ("spacing.x=3", "spacing.x: unknown path, `spacing` is 1 and has no `x`"),
            ("sapcing=3", "sapcing: unknown key `sapcing`, did you mean `spacing`?"),
            ("formulation.xspj=1", "formulation.xspj: unknown key `xspj`, did you mean `xsph`?"),
            ("formulation.viscosity.beta=1", "formulation.viscosity.beta: missing key `alpha` in `formulation.viscosity`"),
            ("formulation.xshp=none", "formulation.xshp: unknown key `xshp`, did you mean `xsph`?"),
            ("body.lft.velocity=[1]", "body.lft.velocity: `body` has no element `lft`, did you mean `left`?"),
            ("body.7.velocity=[1]", "body.7.velocity: `body` has no element `7`, there are 2, counted from 0"),
            ("body.0.velocity.x=1", "body.0.velocity.x: `body.0.velocity` is a list, its elements go by index, not `x`"),
            ("material.stel.density=3", "material.stel.density: there is no `material.stel`, did you mean `steel`?"),
            ("material.stel=none", "material.stel: there is no `material.stel` to remove, did you mean `steel`?"),
            ("variant.plain.spacing=3", "variant.plain.spacing: variants are chosen, not set"),
        ];
        for (text, expected) in cases {
            assert_eq!(set(&["duration=3", text]).err().unwrap_or_default(), format!("--set {expected}"));
        }
    }

    #[test]
    fn overrides_reach_tables_lists_and_words() {
        let texts = [
            "formulation.viscosity.alpha=0.5",
            "formulation.viscosity.beta = 2",
            "body.left.velocity=[3,4]",
            "body.1.velocity=[5]",
            "body.left.velocity.1=6",
            "formulation.smoothing=cubic_spline",
            "title=Three rings",
            "formulation.artificial_stress=none",
        ];
        let read = set(&texts).unwrap();
        let viscosity = read.file.formulation.viscosity.unwrap();
        assert_eq!((viscosity.alpha, viscosity.beta), (0.5, Some(2.0)));
        assert_eq!(read.file.body[0].velocity, Some([3.0, 6.0].into()));
        assert_eq!(read.file.body[1].velocity, Some([5.0].into()));
        assert_eq!(read.file.formulation.smoothing.word(), "cubic_spline");
        assert_eq!(read.file.title, "Three rings");
        assert!(read.file.formulation.artificial_stress.is_none());
        assert_eq!(read.source.place(&["body", "right", "velocity"]), "--set body.1.velocity");
    }

    #[test]
    fn a_variant_merges_lists_by_name_and_replaces_shapes() {
        let read = variant("other");
        let names: Vec<_> = read.file.body.iter().map(|body| body.name.as_str()).collect();
        assert_eq!(names, ["left", "right", "third"]);
        assert!(matches!(read.file.body[1].shape, super::super::shape::Shape::Block { .. }));
        assert_eq!(read.file.body[1].material, "steel");
        assert_eq!(read.file.spacing, 0.5);
        assert_eq!(read.source.place(&["spacing"]), "s.toml:45");
        assert_eq!(read.check_variants(), Ok(()));
    }

    #[test]
    fn none_removes_a_key() {
        let read = variant("plain");
        assert!(read.file.formulation.artificial_stress.is_none());
        assert_eq!(read.file.formulation.viscosity.unwrap().beta, None);
        assert_eq!(read.file.formulation.smoothing.word(), "gaussian");
    }

    #[test]
    fn bad_variants() {
        let choose = |name| read_text(SCENE, "s.toml", Some(name), &[]).err().unwrap_or_default();
        assert_eq!(choose("plan"), "s.toml: unknown variant `plan`, did you mean `plain`?");
        assert_eq!(choose("zebra"), "s.toml: unknown variant `zebra`, expected `other` or `plain`");
        let check = |from: &str, to: &str| {
            assert!(SCENE.contains(from));
            read_text(&SCENE.replacen(from, to, 1), "s.toml", None, &[]).unwrap().check_variants().unwrap_err()
        };
        let misspelt = "s.toml:41: unknown key `artificial_stres`, did you mean `artificial_stress`?";
        assert_eq!(check("artificial_stress = \"none", "artificial_stres = \"none"), misspelt);
        assert_eq!(check("spacing = 0.5", "spcing = 0.5"), "s.toml:45: unknown key `spcing`, did you mean `spacing`?");
        let nested = "s.toml:45: a variant cannot hold variants";
        assert_eq!(check("spacing = 0.5", "variant.x.spacing = 1"), nested);
        let expect = "s.toml:38: unknown variant `plan` in `expect.energy`, did you mean `plain`?";
        assert_eq!(check("norm = \"max\"", "variant = \"plan\""), expect);
    }

    #[test]
    fn the_resolved_text_reads_back() {
        for name in [None, Some("plain"), Some("other")] {
            let mut read = read_text(SCENE, "s.toml", name, &["body.left.spin=1e-300".to_string()]).unwrap();
            let again = read_text(&read.resolved_text, "run.toml", None, &[]).unwrap();
            read.file.variant.clear();
            assert_eq!(format!("{:?}", again.file), format!("{:?}", read.file));
        }
    }

    #[test]
    fn places() {
        let source = set(&[]).unwrap().source;
        assert_eq!(source.place(&[]), "s.toml:1");
        assert_eq!(source.place(&["body"]), "s.toml:6");
        assert_eq!(source.place(&["body", "1"]), "s.toml:12");
        assert_eq!(source.place(&["body", "right", "shape", "disc", "radius"]), "s.toml:14");
        assert_eq!(source.place(&["body", "1", "velocity"]), "s.toml:12");
        assert_eq!(source.place(&["contact", "0", "kernel"]), "s.toml:32");
    }

    #[test]
    fn files() {
        let folder = std::env::temp_dir().join(format!("lithosph-read-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("scene.toml");
        let shown = path.display();
        assert_eq!(read(&path, None, &[]).err(), Some(format!("{shown}: no such file")));
        std::fs::write(&path, b"title = 1\n\xff").unwrap();
        assert_eq!(read(&path, None, &[]).err(), Some(format!("{shown}:2: not UTF-8 text")));
        std::fs::write(&path, SCENE).unwrap();
        assert_eq!(variants(&path).unwrap(), ["plain", "other"]);
        assert_eq!(read(&folder, None, &[]).err(), Some(format!("{}: a folder, not a scene file", folder.display())));
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn the_nearest_word_is_near() {
        let words = ["smoothing", "smoothing_length", "rk2", "rk4", "x"];
        assert_eq!(nearest("smothing", words), Some("smoothing"));
        assert_eq!(nearest("smoothing-lenght", words), Some("smoothing_length"));
        assert_eq!(nearest("LENGTH", words), Some("smoothing_length"));
        assert_eq!(nearest("rk3", words), None);
        assert_eq!(nearest("y", words), None);
        assert_eq!(nearest("", words), None);
    }
}
