//! From a scene file to [`File`]: the TOML with one of its variants merged over it and single values
//! overridden.
//!
//! Every error is one sentence that begins with the place of the mistake. For that each value carries the
//! line that it was typed on.

mod change;
mod from_tree;
mod tree;

use super::file::File;
pub use super::words::{hint, nearest};
use super::words::{list, one_line};
use change::{NAMED, Removal, apply, assign, merge};
use from_tree::deserialize;
pub(crate) use from_tree::is_formulation_key;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use toml::de::DeTable;
use tree::{Entry, NONE, Node, Place, Value, entries, position, show};

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
    /// Tables that the program made: no line of a file stands behind them, and no text.
    pub fn made(file: File, name: &str) -> Self {
        let root = Node { place: Place::Line(1), value: Value::Table(BTreeMap::new()) };
        let document = Document { name: name.into(), root: root.clone(), variants: BTreeMap::new() };
        Self { file, source: Source { name: name.into(), root }, variant: None, resolved_text: String::new(), document }
    }

    /// The same with bodies of the shape that they are typed with.
    pub fn flawless(mut self) -> Self {
        self.file.body.iter_mut().for_each(|body| body.flaw = None);
        self
    }

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
    /// Keys of the table at a path; none where there is no table.
    pub fn keys(&self, path: &[&str]) -> Vec<&str> {
        let mut node = &self.root;
        for part in path {
            let Value::Table(entries) = &node.value else { return Vec::new() };
            let Some(entry) = entries.get(*part) else { return Vec::new() };
            node = &entry.node;
        }
        node.keys()
    }

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

/// The text of a scene file.
///
/// # Errors
/// One sentence that begins with the file.
pub fn text_of(path: &Path) -> Result<String, String> {
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
            // A named formulation was there, and is gone.
            if let ([table, name], true) = (removal.path.as_slice(), removal.existed)
                && table == "formulation"
                && !is_formulation_key(name)
            {
                continue;
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

#[cfg(test)]
mod tests;
