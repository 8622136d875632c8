//! An axis of a matrix, as a command line or a scene has it.

/// An override path and the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub path: String,
    pub values: Vec<Value>,
    /// Where it was typed, for errors.
    pub place: String,
}

/// One value of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Value {
    /// As an override takes it.
    pub typed: String,
    /// In one way however it was typed: `0.20` is `0.2`, and a word goes without quotes.
    pub shown: String,
    /// Further overrides, without which this one makes no scene.
    pub also: Vec<String>,
}

impl Value {
    /// From TOML, or a bare word.
    pub fn parse(text: &str) -> Self {
        match text.parse::<toml::Value>() {
            Ok(value) => Self { typed: text.into(), ..Self::from(&value) },
            Err(_) => Self { typed: text.into(), shown: one_line(text), also: Vec::new() },
        }
    }

    /// With further overrides.
    pub fn and(self, also: Vec<String>) -> Self {
        Self { also, ..self }
    }
}

impl From<&toml::Value> for Value {
    fn from(value: &toml::Value) -> Self {
        let typed = value.to_string();
        let shown = one_line(value.as_str().unwrap_or(&typed));
        Self { typed, shown, also: Vec::new() }
    }
}

impl Axis {
    /// # Errors
    /// One sentence where there is no value, or one comes twice.
    pub fn new(path: &str, place: String, values: Vec<Value>) -> Result<Self, String> {
        if values.is_empty() {
            return Err(format!("{place}: has no value"));
        }
        for (k, value) in values.iter().enumerate() {
            if values[..k].iter().any(|before| before.shown == value.shown) {
                return Err(format!("{place}: the value {} comes twice", value.shown));
            }
        }
        Ok(Self { path: path.into(), values, place })
    }

    /// From `path=value,value`.
    ///
    /// # Errors
    /// One sentence that begins with the option.
    pub fn parse(text: &str) -> Result<Self, String> {
        let Some((path, values)) = text.split_once('=') else {
            return Err(format!("--vary {text}: must be `path=value,value`, found no `=`"));
        };
        let (path, place) = (path.trim(), format!("--vary {}", path.trim()));
        let values: Vec<&str> = split(values).into_iter().map(str::trim).collect();
        if values.iter().any(|value| value.is_empty()) {
            return Err(format!("{place}: has an empty value"));
        }
        Self::new(path, place, values.into_iter().map(Value::parse).collect())
    }
}

/// Parts between the commas that lie outside brackets and quotes.
fn split(text: &str) -> Vec<&str> {
    let (mut parts, mut start, mut depth, mut quote, mut escaped) = (Vec::new(), 0, 0, None, false);
    for (at, letter) in text.char_indices() {
        match (quote, letter) {
            (Some('"'), '\\') if !escaped => {
                escaped = true;
                continue;
            }
            (Some(open), _) if open == letter && !escaped => quote = None,
            (None, '"' | '\'') => quote = Some(letter),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth -= 1,
            (None, ',') if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
        escaped = false;
    }
    parts.push(&text[start..]);
    parts
}

/// A text that fits into a row.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
