//! The files of `src` import each other in no circle of more than three.
//!
//! Files are read as text. What counts is a path that ends at an item: `use crate::a::Item`, `super::f()` or, after
//! `use crate::a`, `a::f()`. It leads to the file that defines the item, past any `pub use`. A `mod` line and a
//! `pub use` import nothing by themselves, and tests may import what they like.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::Path;

/// Most files of one circle.
const MOST: usize = 3;

/// A module: the file that it is.
#[derive(Debug, Default)]
struct Module {
    file: String,
    /// Names in scope and the paths that they stand for.
    imports: BTreeMap<String, Vec<String>>,
    /// Paths whose names are all in scope.
    globs: Vec<Vec<String>>,
    /// The same of `pub use`.
    exports: BTreeMap<String, Vec<String>>,
    export_globs: Vec<Vec<String>>,
    /// Paths in code.
    paths: BTreeSet<Vec<String>>,
    /// A macro writes paths that begin with its arguments.
    generates: bool,
    words: BTreeSet<String>,
}

/// Modules by their path, `""` the root.
type Crate = BTreeMap<String, Module>;
/// Files and the files that they import.
type Graph = BTreeMap<String, BTreeSet<String>>;

/// Words, `::` and single signs of the code, without comments, texts and lifetimes.
fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let mut list = Vec::new();
    let mut at = 0;
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    while at < chars.len() {
        let (c, next) = (chars[at], chars.get(at + 1).copied().unwrap_or(' '));
        match (c, next) {
            ('/', '/') => at += chars[at..].iter().position(|&c| c == '\n').unwrap_or(chars.len() - at),
            ('/', '*') => {
                let close = chars[at..].windows(2).position(|pair| pair == ['*', '/']);
                at += close.map_or(chars.len() - at, |length| length + 2);
            }
            ('r', '"' | '#') if chars[at + 1..].iter().find(|&&c| c != '#') == Some(&'"') => {
                let hashes = chars[at + 1..].iter().take_while(|&&c| c == '#').count();
                let end: Vec<char> = std::iter::once('"').chain(std::iter::repeat_n('#', hashes)).collect();
                let body = at + 2 + hashes;
                let length = chars[body..].windows(end.len()).position(|part| part == end).unwrap_or(chars.len() - body);
                at = (body + length + end.len()).min(chars.len());
            }
            ('"', _) => {
                at += 1;
                while at < chars.len() && chars[at] != '"' {
                    at += if chars[at] == '\\' { 2 } else { 1 };
                }
                at += 1;
            }
            ('\'', '\\') => at += 3 + chars[at + 3..].iter().position(|&c| c == '\'').unwrap_or(0),
            ('\'', _) if chars.get(at + 2) == Some(&'\'') => at += 3,
            ('\'', _) => at += 1 + chars[at + 1..].iter().take_while(|&&c| is_word(c)).count(),
            (':', ':') => {
                list.push("::".into());
                at += 2;
            }
            _ if is_word(c) => {
                let length = chars[at..].iter().take_while(|&&c| is_word(c)).count();
                list.push(chars[at..at + length].iter().collect());
                at += length;
            }
            _ => {
                if !c.is_whitespace() {
                    list.push(c.into());
                }
                at += 1;
            }
        }
    }
    list
}

/// Where an item that begins at `from` ends: past its first closed braces, or past a semicolon outside of them.
fn item_end(tokens: &[String], from: usize) -> usize {
    let mut depth = 0i32;
    for (k, token) in tokens.iter().enumerate().skip(from) {
        match token.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth -= 1,
            _ => {}
        }
        if depth == 0 && matches!(token.as_str(), ";" | "}") {
            return k + 1;
        }
    }
    tokens.len()
}

/// The tokens that are not for tests, and the names of modules that are.
fn without_tests(tokens: &[String]) -> (Vec<String>, Vec<String>) {
    let (mut kept, mut modules) = (Vec::new(), Vec::new());
    let test = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut at = 0;
    while at < tokens.len() {
        if tokens[at..].iter().take(test.len()).eq(test.iter()) {
            let end = item_end(tokens, at + test.len());
            let item = &tokens[at + test.len()..end];
            if let Some(k) = item.iter().position(|token| token == "mod").filter(|_| item.ends_with(&[";".into()])) {
                modules.push(item[k + 1].clone());
            }
            at = end;
        } else {
            kept.push(tokens[at].clone());
            at += 1;
        }
    }
    (kept, modules)
}

/// The paths of a `use` tree that begins at `at`, each with the name that it gives; `*` for all names. Returns the end.
fn use_tree(tokens: &[String], mut at: usize, before: &[String], found: &mut Vec<(Vec<String>, String)>) -> usize {
    let mut path = before.to_vec();
    loop {
        match tokens[at].as_str() {
            "::" => at += 1,
            "{" => {
                at += 1;
                while tokens[at] != "}" {
                    at = use_tree(tokens, at, &path, found);
                    at += usize::from(tokens[at] == ",");
                }
                return at + 1;
            }
            "*" => {
                found.push((path, "*".into()));
                return at + 1;
            }
            "as" => {
                found.push((path, tokens[at + 1].clone()));
                return at + 2;
            }
            "," | "}" | ";" => {
                if path.len() > 1 && path.last().is_some_and(|word| word == "self") {
                    path.pop();
                }
                let name = path.last().cloned().unwrap_or_default();
                found.push((path, name));
                return at;
            }
            word => {
                path.push(word.into());
                at += 1;
            }
        }
    }
}

fn module(file: &str, tokens: &[String]) -> Module {
    let mut module = Module { file: file.into(), ..Module::default() };
    let mut at = 0;
    while at < tokens.len() {
        let word = tokens[at].as_str();
        let begins = at == 0 || tokens[at - 1] != "::";
        if word == "use" {
            let public = at > 0 && matches!(tokens[at - 1].as_str(), "pub" | ")");
            let mut found = Vec::new();
            at = use_tree(tokens, at + 1, &[], &mut found);
            for (path, name) in found {
                if path == [name.as_str()] {
                    continue; // A macro that this file defines.
                }
                match (public, name.as_str()) {
                    (false, "*") => module.globs.push(path),
                    (true, "*") => module.export_globs.push(path),
                    (false, _) => _ = module.imports.insert(name, path),
                    (true, _) => _ = module.exports.insert(name, path),
                }
            }
        } else if word == "mod" {
            at += 2;
        } else if word.chars().all(|c| c.is_alphanumeric() || c == '_') {
            let generated = at > 0 && tokens[at - 1] == "$" && word != "crate";
            let mut path = vec![word.to_string()];
            while tokens.get(at + 1).is_some_and(|next| next == "::")
                && tokens.get(at + 2).is_some_and(|next| next.chars().all(|c| c.is_alphanumeric() || c == '_'))
            {
                path.push(tokens[at + 2].clone());
                at += 2;
            }
            module.generates |= generated && path.len() > 1;
            module.words.insert(path[0].clone());
            if begins && !generated && path.len() > 1 {
                module.paths.insert(path);
            }
            at += 1;
        } else {
            at += 1;
        }
    }
    module
}

fn child(of: &str, name: &str) -> String {
    if of.is_empty() { name.into() } else { format!("{of}::{name}") }
}

fn parent(of: &str) -> String {
    of.rsplit_once("::").map_or_else(String::new, |(parent, _)| parent.into())
}

/// Module path of a file below `src`.
fn module_path(file: &str) -> String {
    let stem = file.trim_end_matches(".rs");
    let stem = if stem == "lib" { "" } else { stem.trim_end_matches("/mod") };
    stem.replace('/', "::")
}

/// Files by their place below `src`, without tests.
fn parse(sources: &BTreeMap<String, String>) -> Crate {
    let (mut all, mut tests) = (Crate::new(), Vec::new());
    for (file, text) in sources {
        let path = module_path(file);
        let (code, test_modules) = without_tests(&tokens(text));
        tests.extend(test_modules.iter().map(|name| child(&path, name)));
        all.insert(path, module(file, &code));
    }
    all.retain(|path, _| !tests.iter().any(|test| path == test || path.starts_with(&format!("{test}::"))));
    all
}

/// Where a path leads.
#[derive(Debug)]
enum Place {
    Module(String),
    /// An item that the module defines.
    Item(String),
}

/// Follows a path from inside a module. None where it leaves the crate. `private` looks at imports too.
fn follow(all: &Crate, from: &str, path: &[String], private: bool, depth: usize) -> Option<Place> {
    let (first, rest) = path.split_first()?;
    let module = &all[from];
    let mut here = match first.as_str() {
        _ if depth > 16 => return None,
        "crate" => String::new(),
        "self" => from.to_string(),
        "super" => parent(from),
        name if all.contains_key(&child(from, name)) => child(from, name),
        name => {
            let named = module.imports.get(name).filter(|_| private).or_else(|| module.exports.get(name))?;
            match follow(all, from, named, false, depth + 1)? {
                Place::Module(next) => next,
                item => return Some(item),
            }
        }
    };
    for (k, name) in rest.iter().enumerate() {
        let last = k + 1 == rest.len();
        let exported = all[&here].exports.get(name);
        let below = child(&here, name);
        here = match exported {
            _ if name == "super" => parent(&here),
            // A module and an item of its own may share a name.
            Some(path) if last || !all.contains_key(&below) => match follow(all, &here, path, false, depth + 1)? {
                Place::Module(next) => next,
                item => return Some(item),
            },
            _ if all.contains_key(&below) => below,
            _ => {
                let glob = all[&here].export_globs.iter().find_map(|path| {
                    let Place::Module(next) = follow(all, &here, path, false, depth + 1)? else { return None };
                    all[&next].words.contains(name).then_some(Place::Item(next))
                });
                return Some(glob.unwrap_or(Place::Item(here)));
            }
        };
    }
    Some(Place::Module(here))
}

fn graph(all: &Crate) -> Graph {
    let mut graph = Graph::new();
    for (path, module) in all {
        let mut found = BTreeSet::new();
        for import in module.imports.values().chain(&module.paths) {
            if let Some(Place::Item(at)) = follow(all, path, import, true, 0) {
                found.insert(all[&at].file.clone());
            }
        }
        for glob in &module.globs {
            if let Some(Place::Item(at) | Place::Module(at)) = follow(all, path, glob, true, 0) {
                found.insert(all[&at].file.clone());
            }
        }
        if module.generates {
            let children = module.words.iter().filter_map(|word| all.get(&child(path, word)));
            found.extend(children.map(|module| module.file.clone()));
        }
        found.remove(&module.file);
        graph.insert(module.file.clone(), found);
    }
    graph
}

/// The shortest way from one file to another, both ends included.
fn way(graph: &Graph, from: &str, to: &str) -> Option<Vec<String>> {
    let mut before: BTreeMap<&str, &str> = BTreeMap::new();
    let mut queue = VecDeque::from([from]);
    while let Some(file) = queue.pop_front() {
        for next in &graph[file] {
            if before.contains_key(next.as_str()) {
                continue;
            }
            before.insert(next, file);
            if next == to {
                let mut list = vec![to.to_string()];
                let mut at = file;
                while at != from {
                    list.push(at.into());
                    at = before[at];
                }
                list.push(from.into());
                list.reverse();
                return Some(list);
            }
            queue.push_back(next);
        }
    }
    None
}

fn reachable<'a>(graph: &'a Graph, from: &'a str) -> BTreeSet<&'a str> {
    let (mut seen, mut left) = (BTreeSet::new(), vec![from]);
    while let Some(file) = left.pop() {
        left.extend(graph[file].iter().map(String::as_str).filter(|next| seen.insert(*next)));
    }
    seen
}

/// Sets of files that all reach each other, of two and more.
fn circles(graph: &Graph) -> Vec<BTreeSet<String>> {
    let reach: BTreeMap<&str, BTreeSet<&str>> = graph.keys().map(|file| (file.as_str(), reachable(graph, file))).collect();
    let mut list: Vec<BTreeSet<String>> = Vec::new();
    for (file, reached) in &reach {
        let circle: BTreeSet<String> =
            reached.iter().filter(|other| reach[**other].contains(file)).map(|other| (*other).into()).collect();
        if circle.len() > 1 && !list.contains(&circle) {
            list.push(circle);
        }
    }
    list
}

/// Circles of more than [`MOST`] files: their files, and for each the shortest way round from it.
fn complaints(graph: &Graph) -> Vec<String> {
    let too_large = |circle: &&BTreeSet<String>| circle.len() > MOST;
    let told = |circle: &BTreeSet<String>| {
        let ways: BTreeSet<String> =
            circle.iter().filter_map(|file| way(graph, file, file)).map(|way| format!("  {}", way.join(" imports "))).collect();
        let ways: Vec<String> = ways.into_iter().collect();
        format!("{} files import each other in a circle:\n{}", circle.len(), ways.join("\n"))
    };
    circles(graph).iter().filter(too_large).map(told).collect()
}

fn read(folder: &Path, under: &str, sources: &mut BTreeMap<String, String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("{under}{}", path.file_name().unwrap().to_str().unwrap());
        if path.is_dir() && !name.ends_with("tests") {
            read(&path, &format!("{name}/"), sources);
        } else if name.ends_with(".rs") && !name.ends_with("tests.rs") && name != "main.rs" {
            sources.insert(name, std::fs::read_to_string(&path).unwrap());
        }
    }
}

#[test]
fn no_circle_of_imports_has_more_than_three_files() {
    let mut sources = BTreeMap::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), "", &mut sources);
    let complaints = complaints(&graph(&parse(&sources)));
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

fn sources<const N: usize>(files: [(&str, &str); N]) -> BTreeMap<String, String> {
    files.into_iter().map(|(file, text)| (file.into(), text.into())).collect()
}

#[test]
fn a_circle_is_found_through_every_way_to_name_a_file() {
    let circle = sources([
        ("lib.rs", "pub mod a;\npub mod b;\npub mod c;\nmod d;"),
        ("a/mod.rs", "mod inner;\npub use inner::{Thing, other as another};"),
        ("a/inner.rs", "// crate::d::X\npub struct Thing(crate::b::B);"),
        ("b.rs", "use super::c;\n#[cfg(test)]\nmod tests { use crate::d::Nothing; }\nfn f() { c::g(\"crate::d::X\") }"),
        ("c.rs", "macro_rules! all { ($($w:ident)*) => { $($w::run();)* } }\nmod part;\nall! { part }"),
        ("c/part.rs", "use crate::{d as last};\nfn run() { last::run() }"),
        ("d.rs", "use crate::a::Thing;\nfn run() {}"),
    ]);
    let graph = graph(&parse(&circle));
    let found = circles(&graph);
    assert_eq!(found.len(), 1, "{graph:?}");
    assert_eq!(found[0].iter().map(String::as_str).collect::<Vec<_>>(), ["a/inner.rs", "b.rs", "c.rs", "c/part.rs", "d.rs"]);
    let told = complaints(&graph);
    let way = "a/inner.rs imports b.rs imports c.rs imports c/part.rs imports d.rs imports a/inner.rs";
    assert!(told.len() == 1 && told[0].contains(way), "{told:?}");
}

#[test]
fn three_files_may_import_each_other_and_tests_anything() {
    let small = sources([
        ("lib.rs", "mod a;\nmod b;\nmod c;\nmod d;"),
        ("a.rs", "use crate::b::B;\npub struct A;"),
        ("b.rs", "use crate::c::C;\npub struct B;"),
        ("c.rs", "use crate::a::A;\n#[cfg(test)]\nuse crate::d::D;\npub struct C;"),
        ("d.rs", "use crate::a::A;\npub struct D;"),
    ]);
    let graph = graph(&parse(&small));
    assert_eq!(circles(&graph)[0].len(), 3);
    assert!(complaints(&graph).is_empty());
}
