//! Changes to a scene's tree: a variant merged over it, an override put at its path.

use super::super::words::{hint, is_choice, one_line, quoted};
use super::from_tree::is_formulation_key;
use super::tree::{Entry, Node, Place, Value, node, position};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry::{Occupied, Vacant};
use toml::de::DeValue;

/// Tables whose keys are names that the scene chooses.
pub(super) const NAMED: [&str; 3] = ["material", "observe", "expect"];

/// A key that a variant or an override took away.
pub(super) struct Removal {
    pub path: Vec<String>,
    pub place: Place,
    pub existed: bool,
}

/// Merges `change` over `base`; `path` is the place of both in the scene.
pub(super) fn merge(base: &mut Node, change: Node, path: &mut Vec<String>, removals: &mut Vec<Removal>) {
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

/// Applies one override `path=value`.
pub(super) fn apply(root: &mut Node, text: &str, removals: &mut Vec<Removal>) -> Result<(), String> {
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
        && (NAMED.contains(&table.as_str()) || (table == "formulation" && !is_formulation_key(name)))
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
pub(super) fn assign(
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
