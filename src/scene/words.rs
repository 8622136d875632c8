//! Complaints about a scene in plain words: serde names Rust types and TOML byte ranges, this names the
//! scene's own keys and what belongs there.

use glam::DVec3;

/// What serde found wrong, with the part of the scene that it concerns.
pub(super) struct Fault<'a> {
    /// serde's own words.
    pub message: &'a str,
    /// Keys and indices down to the value or key at fault.
    pub path: &'a [String],
    /// The value at fault in words: "a string", "3".
    pub found: String,
    /// The value at fault where it is a single word.
    pub word: Option<&'a str>,
    /// The keys of the value at fault where it is a table.
    pub keys: Vec<&'a str>,
    /// Whether the last key of the path is one of the scene itself.
    pub top: bool,
}

/// Keys whose value is a table of exactly one key, which says what kind of thing it holds.
const CHOICES: [(&str, &str); 8] = [
    ("shape", SHAPE),
    ("inside", SHAPE),
    ("from", SHAPE),
    ("hardening", "a table such as `{ linear = 0.1 }`"),
    ("pressure", "a word or a table such as `{ linear = { bulk_modulus = 1.0 } }`"),
    ("strength", "a word or a table such as `{ j2 = { yield_stress = 0.1 } }`"),
    ("heat", "a table such as `{ isothermal = { temperature = 293 } }`"),
    ("motion", "a table such as `{ wave = { amplitude = [1], wave_vector = [2] } }`"),
];
const SHAPE: &str = "a table such as `{ disc = { center = [0, 0], radius = 1 } }`";

/// What belongs in values that may take more than one type, where serde only says that none fits.
const UNTAGGED: [(&str, &str); 3] = [
    ("fixed", "true, false or a list of them, one for each axis"),
    ("velocity", "a list of numbers and \"free\", one for each axis"),
    ("scale", "a number above 0, \"peak\" or \"mean\""),
];

/// What belongs under `[study.accuracy]`; a path without its quotes makes a table.
const STUDIED: &str = "a list of values under a path in quotes such as `\"time.cfl\" = [0.2, 0.4]`";

/// What lists hold that hold no numbers.
const LISTS: [(&str, &str); 14] = [
    ("body", "a list of tables, each under `[[body]]`"),
    ("contact", "a list of tables, each under `[[contact]]`"),
    ("boundary", "a list of tables, each under `[[boundary]]`"),
    ("symmetry", "a list of tables, each under `[[symmetry]]`"),
    ("kick", "a list of tables, each under `[[kick]]`"),
    ("fields", "a list of strings"),
    ("between", "a list of the names of 2 bodies"),
    ("columns", "a list of strings"),
    ("bounds", "a list of 2 points"),
    ("points", "a list of points"),
    ("course", "a list of pairs of numbers"),
    ("gradient", "a list of rows of numbers"),
    ("of", "a list of shapes"),
    ("remove", "a list of shapes"),
];

/// Whether the table under this key holds one thing of several, so that naming another replaces it.
pub(super) fn is_choice(key: &str) -> bool {
    look_up(&CHOICES, key).is_some()
}

/// Keys of the scene itself that are tables: no line that is out of place becomes right before all tables.
const TABLES: [&str; 15] = [
    "body",
    "material",
    "formulation",
    "contact",
    "obstacle",
    "boundary",
    "symmetry",
    "kick",
    "time",
    "quasi_static",
    "output",
    "observe",
    "expect",
    "study",
    "variant",
];

/// What is typed under an observable for its selection.
const SELECTIONS: [&str; 5] = ["boundary", "select", "selection", "region", "particles"];

/// What is wrong and what was expected, in one sentence without its place.
pub(super) fn sentence(fault: &Fault) -> String {
    let message = fault.message;
    let path = quoted(fault.path);
    // toml hands a date to a struct as a table of one key of its own.
    if message.contains("$__toml_private") {
        return format!("{path} must be a table, found {}", fault.found);
    }
    if message.starts_with("unknown field") {
        return unknown_key(fault);
    }
    if message.starts_with("unknown variant") {
        return unknown_word(fault);
    }
    if let Some(key) = between(message, "missing field `", "`") {
        return missing_key(key, fault.path);
    }
    let is_one_of = fault.path.iter().rev().find(|part| !is_index(part)).is_some_and(|key| choice(key).is_some());
    if message.starts_with("wanted exactly 1 element") && is_one_of {
        let found = if fault.keys.is_empty() { "none".to_string() } else { list(&fault.keys, "and") };
        return format!("{path} must have exactly one key, found {found}");
    }
    if message.ends_with("overflowed") {
        return format!("{path} is too large a number");
    }
    // A word that holds nothing was typed as a key with a value.
    if let (true, Some((_, path))) = (message.ends_with(", expected unit"), fault.path.split_last()) {
        let wanted = wanted("wanted string or table", path).unwrap_or_default();
        return format!("{} must be {wanted}, found a table", quoted(path));
    }
    match wanted(message, fault.path) {
        // One of the elements does not fit, and serde does not say which.
        Some(wanted) if message.starts_with("data did not match") && fault.found == "a list" => {
            format!("{path} must be {wanted}")
        }
        Some(wanted) => format!("{path} must be {wanted}, found {}", found(fault)),
        None => format!("{path} is wrong: {}", one_line(message)),
    }
}

/// Nearest of the valid words, for "did you mean"; none where several are as near.
pub fn nearest<'a>(word: &str, valid: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = plain(word);
    let length = word.chars().count();
    let limit = length.div_ceil(3).min(length.saturating_sub(1));
    let measure = |candidate: &'a str| {
        let plain = plain(candidate);
        let distance = strsim::damerau_levenshtein(&word, &plain);
        let related = is_part(&word, &plain) || (plain.len() > 2 && word.starts_with(&plain));
        let distance = if distance <= limit { Some(distance) } else { related.then_some(RELATED) };
        distance.map(|distance| (distance, candidate))
    };
    let mut near: Vec<_> = valid.into_iter().filter_map(measure).collect();
    near.sort_by_key(|(distance, _)| *distance);
    match near[..] {
        [(_, only)] => Some(only),
        [(first, nearest), (second, _), ..] if first < second => Some(nearest),
        _ => None,
    }
}

/// As far as two slips of the finger: a word of which only a part was typed, as `cubic` of `cubic_spline`.
const RELATED: usize = 2;

fn is_part(word: &str, of: &str) -> bool {
    word.len() > 2 && format!("_{of}_").contains(&format!("_{word}_"))
}

/// ", did you mean `x`?" or else the words there are.
pub fn hint(word: &str, valid: &[&str]) -> String {
    match nearest(word, valid.iter().copied()) {
        Some(near) => format!(", did you mean `{near}`?"),
        None if valid.is_empty() => ", none is expected here".to_string(),
        None => format!(", expected {}", list(valid, "or")),
    }
}

/// A path in backticks.
pub(super) fn quoted(path: &[String]) -> String {
    if path.is_empty() { "the scene".to_string() } else { format!("`{}`", path.join(".")) }
}

/// A message without the line breaks that a key or string in it may hold.
pub(super) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn unknown_key(fault: &Fault) -> String {
    let Some((key, table)) = fault.path.split_last() else {
        return one_line(fault.message);
    };
    let valid = expected_words(fault.message, key);
    if table.first().is_some_and(|table| table == "observe") && SELECTIONS.contains(&key.as_str()) {
        return format!(
            "unknown key `{key}` in {}: an observable names its particles by `body`, by `inside`, which takes the shape that a \
             boundary selects, or by both",
            quoted(table)
        );
    }
    if !table.is_empty() && fault.top && !TABLES.contains(&key.as_str()) {
        return format!("unknown key `{key}` in {}, it belongs at the top of the scene, before all tables", quoted(table));
    }
    let inside = match nearest(key, valid.iter().copied()) {
        None if !table.is_empty() => format!(" in {}", quoted(table)),
        _ => String::new(),
    };
    format!("unknown key `{}`{inside}{}", one_line(key), hint(key, &valid))
}

/// The word is a string, or the one key of a table that says what it holds.
fn unknown_word(fault: &Fault) -> String {
    let (word, path) = match (fault.word, fault.path.split_last()) {
        (Some(word), _) if fault.message.starts_with(&format!("unknown variant `{word}`")) => (word, fault.path),
        (_, Some((key, table))) => (key.as_str(), table),
        (word, None) => (word.unwrap_or_default(), fault.path),
    };
    let valid = expected_words(fault.message, word);
    format!("unknown word `{}` for {}{}", one_line(word), quoted(path), hint(word, &valid))
}

fn missing_key(key: &str, table: &[String]) -> String {
    if table.is_empty() {
        format!("missing key `{key}` at the top of the scene")
    } else {
        format!("missing key `{key}` in {}", quoted(table))
    }
}

/// The words in backticks after the one that serde did not know.
fn expected_words<'a>(message: &'a str, unknown: &str) -> Vec<&'a str> {
    let start = message.find(&format!("`{unknown}`")).map_or(0, |start| start + unknown.len() + 2);
    message[start..].split('`').skip(1).step_by(2).collect()
}

/// What belongs at a path, from the type that serde expected there.
fn wanted(message: &str, path: &[String]) -> Option<String> {
    let key = path.iter().rev().find(|part| !is_index(part)).map_or("", String::as_str);
    let own = path.last().map_or("", String::as_str);
    if message.starts_with("data did not match any variant") {
        return look_up(&UNTAGGED, key).map(str::to_string);
    }
    if let Some(table) = message.strip_prefix("wanted the table ") {
        return Some(format!("a table {table}"));
    }
    if message.starts_with("wanted") || message.contains(": unit variant, expected") {
        return Some(match (choice(key), key) {
            (Some(choice), _) => choice.to_string(),
            (None, "spacing") => "\"initial\", \"mean\" or a table such as `{ given = 0.1 }`".to_string(),
            _ => "a word".to_string(),
        });
    }
    let (_, expected) = message.rsplit_once(", expected ")?;
    Some(match expected {
        "f64" | "f32" => "a number".to_string(),
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, 0 or more".to_string(),
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number".to_string(),
        "a boolean" => "true or false".to_string(),
        "a string" => "a string".to_string(),
        "a sequence" if path.first().is_some_and(|table| table == "boundary") && own == "velocity" => UNTAGGED[1].1.to_string(),
        "a sequence" if path.first().is_some_and(|table| table == "study") => STUDIED.to_string(),
        "a sequence" => look_up(&LISTS, own).unwrap_or("a list of numbers").to_string(),
        "a map" => "a table".to_string(),
        "a word or a table" => choice(own).unwrap_or("a table").to_string(),
        _ if expected.starts_with("struct") || expected.contains("struct variant") => "a table".to_string(),
        _ => list_of_length(expected, own, path)?,
    })
}

fn is_index(part: &str) -> bool {
    part.parse::<usize>().is_ok()
}

fn list_of_length(expected: &str, key: &str, path: &[String]) -> Option<String> {
    let length = expected.strip_prefix("an array of length ")?;
    // Bodies touch `between` names; an observable and an expectation hold `between` numbers.
    let names = key == "between" && path.first().is_some_and(|table| table == "contact");
    let words = look_up(&LISTS, key).filter(|_| key != "between" || names);
    Some(words.map_or(format!("a list of {length} numbers"), str::to_string))
}

fn found(fault: &Fault) -> String {
    match between(fault.message, "invalid length ", ",") {
        Some(length) if fault.message.contains("an array of length") => {
            format!("a list of {length}")
        }
        _ => fault.found.clone(),
    }
}

/// A number with a few significant digits, without zeros at the end.
pub fn rounded(number: f64, digits: usize) -> String {
    let text = format!("{number:.*e}", digits - 1);
    match text.parse::<f64>() {
        Ok(number) if number == 0.0 || (1e-4..1e6).contains(&number.abs()) => format!("{number}"),
        Ok(number) => format!("{number:e}"),
        Err(_) => text,
    }
}

/// A place as "(x, y)", with as many coordinates as the scene has.
pub fn place(place: DVec3, dimension: usize) -> String {
    let numbers: Vec<String> = place.to_array()[..dimension].iter().map(|&number| rounded(number, 4)).collect();
    format!("({})", numbers.join(", "))
}

/// Words in backticks: "`a`, `b` or `c`".
pub(super) fn list(words: &[&str], joint: &str) -> String {
    let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    match words.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} {joint} {last}", rest.join(", ")),
        _ => words.concat(),
    }
}

fn between<'a>(text: &'a str, before: &str, after: &str) -> Option<&'a str> {
    let (inner, _) = text.strip_prefix(before)?.split_once(after)?;
    Some(inner)
}

/// What a table that names one thing of several looks like; shapes also lie in lists.
fn choice(key: &str) -> Option<&'static str> {
    look_up(&CHOICES, key).or(["of", "remove"].contains(&key).then_some(SHAPE))
}

fn look_up(table: &[(&str, &'static str)], key: &str) -> Option<&'static str> {
    table.iter().find(|(name, _)| *name == key).map(|(_, words)| *words)
}

/// Case and the kind of dash are no reason not to recognise a word.
fn plain(word: &str) -> String {
    word.to_lowercase().replace(['-', ' '], "_")
}
