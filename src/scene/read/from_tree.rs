//! From the tree to [`File`]: serde asks, the tree answers, and an error learns its place on the way out.
//! No table is typed as a list, no list has more than is asked for, and no word has a table.

use super::super::file::{File, FormulationTable};
use super::super::words::{Fault, nearest, sentence};
use super::tree::{Entry, Node, Place, Value, show};
use serde::Deserialize;
use serde::de::value::{BorrowedStrDeserializer, MapDeserializer};
use serde::de::{DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, SeqAccess};
use serde::de::{Unexpected, VariantAccess, Visitor};
use std::collections::{BTreeMap, btree_map};
use std::iter::Enumerate;
use std::{fmt, slice};

/// Keys of `[formulation]` whose value is a table.
const OWN_TABLES: [&str; 2] = ["viscosity", "artificial_stress"];
/// Key under which [`File`] has the named formulations.
const FORMULATIONS: &str = "formulations";
/// The one key of the table that toml makes of a date.
const DATE: &str = "$__toml_private_datetime";

pub(super) fn deserialize(root: &Node, name: &str) -> Result<File, String> {
    if root.keys().contains(&FORMULATIONS) {
        return Err(format!("{name}: unknown key `{FORMULATIONS}`: a named formulation is typed as [formulation.NAME]"));
    }
    let root = &formulations_apart(root);
    let mut file = File::deserialize(root).map_err(|wrong| wrong.complaint(root, name))?;
    file.settle_kinds(|formulation| match (formulation, root.under(FORMULATIONS)) {
        (None, _) => root.names("formulation").contains(&"kind"),
        (Some(formulation), named) => named.is_some_and(|named| named.names(formulation).contains(&"kind")),
    });
    file.settle_packings();
    Ok(file)
}

/// The scene with its named formulations beside the plain one, where serde finds them by their type. A table under a key
/// of the formulation itself, or nearly under one that is a table, is left to be refused as a slip.
fn formulations_apart(root: &Node) -> Node {
    let mut root = root.clone();
    let Value::Table(tables) = &mut root.value else { return root };
    let Some(Entry { place, node: Node { value: Value::Table(keys), .. } }) = tables.get_mut("formulation") else { return root };
    let named = |key: &str, entry: &Entry| {
        let table = matches!(entry.node.value, Value::Table(_));
        table && !is_formulation_key(key) && nearest(key, OWN_TABLES).is_none()
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

/// Whether a formulation has the key.
pub(crate) fn is_formulation_key(key: &str) -> bool {
    knows::<FormulationTable>(key)
}

/// Whether a table that is read as this type may have the key.
fn knows<T: DeserializeOwned>(key: &str) -> bool {
    let place = Place::Line(1);
    let entry = Entry { place: place.clone(), node: Node { place: place.clone(), value: Value::List(Vec::new()) } };
    let table = Node { place, value: Value::Table(BTreeMap::from([(key.to_string(), entry)])) };
    !T::deserialize(&table).is_err_and(|wrong| wrong.message.starts_with("unknown field"))
}

/// What serde found wrong.
#[derive(Debug)]
pub(super) struct Wrong<'a> {
    message: String,
    /// The place of the value or key at fault, and the value, as soon as one is known.
    site: Option<(&'a Place, &'a Node)>,
    /// Keys and indices down to it, the last first.
    path: Vec<String>,
}

impl<'a> Wrong<'a> {
    /// This value is at fault, unless one inside it is.
    fn at(mut self, place: &'a Place, node: &'a Node) -> Self {
        self.site.get_or_insert((place, node));
        self
    }

    /// The fault lies under this key or index. An element of no known place is left to be told as its list's.
    fn under(mut self, part: &str) -> Self {
        self.path.extend(self.site.map(|_| part.replace(FORMULATIONS, "formulation")));
        self
    }

    fn complaint(mut self, root: &'a Node, name: &str) -> String {
        self.path.reverse();
        let (place, node) = self.site.unwrap_or((&root.place, root));
        let word = if let Value::Text(word) = &node.value { Some(word.as_str()) } else { None };
        let top = self.path.last().is_some_and(|key| knows::<File>(key));
        let fault = Fault { message: &self.message, path: &self.path, found: node.describe(), word, keys: node.keys(), top };
        format!("{}: {}", show(name, place), sentence(&fault))
    }
}

impl fmt::Display for Wrong<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(&self.message)
    }
}

impl std::error::Error for Wrong<'_> {}

impl Error for Wrong<'_> {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self { message: message.to_string(), site: None, path: Vec::new() }
    }
}

impl Node {
    /// A list of tables is told by the line of its first key.
    fn first(&self) -> &Place {
        if let Value::List(items) = &self.value
            && let Some(Value::Table(entries)) = items.first().map(|item| &item.value)
            && let Some(entry) = entries.values().next()
        {
            return &entry.place;
        }
        &self.place
    }
}

type Words = &'static [&'static str];

/// Types ask by the method of their own kind, so that none is compiled with the code of all kinds.
impl<'de> Deserializer<'de> for &'de Node {
    type Error = Wrong<'de>;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong<'de>> {
        let read = match &self.value {
            Value::Table(_) => return self.deserialize_map(visitor),
            Value::List(_) => return self.deserialize_seq(visitor),
            Value::Text(text) => visitor.visit_borrowed_str(text),
            Value::Literal(text) => match (text.parse(), text.parse()) {
                (Ok(toml::Value::Boolean(truth)), _) => visitor.visit_bool(truth),
                (Ok(toml::Value::Integer(number)), _) => visitor.visit_i64(number),
                (Ok(toml::Value::Float(number)), _) => visitor.visit_f64(number),
                (Ok(_), _) => visitor.visit_map(MapDeserializer::new(std::iter::once((DATE, text.as_str())))),
                (Err(_), Ok(number)) => visitor.visit_u64(number),
                (Err(_), Err(_)) => Err(Wrong::custom("number overflowed")),
            },
        };
        read.map_err(|wrong| wrong.at(&self.place, self))
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong<'de>> {
        let read = match &self.value {
            Value::Table(entries) => visitor.visit_map(Entries { rest: entries.iter(), last: None }),
            _ => Err(Wrong::invalid_type(Unexpected::Other("value"), &visitor).at(self.first(), self)),
        };
        read.map_err(|wrong| wrong.at(&self.place, self))
    }

    fn deserialize_struct<V: Visitor<'de>>(self, _: &'static str, _: Words, visitor: V) -> Result<V::Value, Wrong<'de>> {
        self.deserialize_map(visitor)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong<'de>> {
        let read = match &self.value {
            Value::List(items) => visitor.visit_seq(Items(items.iter().enumerate())),
            _ => Err(Wrong::invalid_type(Unexpected::Other("value"), &visitor)),
        };
        read.map_err(|wrong| wrong.at(&self.place, self))
    }

    /// An array takes its own elements and leaves the rest.
    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Wrong<'de>> {
        let read = self.deserialize_seq(visitor)?;
        match &self.value {
            Value::List(items) if items.len() > length => {
                Err(Wrong::invalid_length(items.len(), &format!("an array of length {length}").as_str()).at(&self.place, self))
            }
            _ => Ok(read),
        }
    }

    /// A word alone, or as the one key of a table with what it holds.
    fn deserialize_enum<V: Visitor<'de>>(self, _: &'static str, _: Words, visitor: V) -> Result<V::Value, Wrong<'de>> {
        let read = match &self.value {
            Value::Text(word) => visitor.visit_enum(BorrowedStrDeserializer::new(word)),
            Value::Table(entries) => match entries.iter().next() {
                Some((key, entry)) if entries.len() == 1 => visitor.visit_enum(Choice { key, entry }),
                _ => Err(Wrong::custom("wanted exactly 1 element")),
            },
            _ => Err(Wrong::custom("wanted string or table")),
        };
        read.map_err(|wrong| wrong.at(&self.place, self))
    }

    /// What is not typed is none, so that what is there is some.
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong<'de>> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Wrong<'de>> {
        visitor.visit_newtype_struct(self)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct
        tuple_struct identifier ignored_any
    }
}

/// The entries of a table that serde has not yet asked for.
struct Entries<'a> {
    rest: btree_map::Iter<'a, String, Entry>,
    /// The one of which it has the key.
    last: Option<(&'a String, &'a Entry)>,
}

impl<'a> MapAccess<'a> for Entries<'a> {
    type Error = Wrong<'a>;

    fn next_key_seed<K: DeserializeSeed<'a>>(&mut self, seed: K) -> Result<Option<K::Value>, Wrong<'a>> {
        self.last = self.rest.next();
        let Some((key, entry)) = self.last else { return Ok(None) };
        let read = seed.deserialize(BorrowedStrDeserializer::new(key)).map(Some);
        read.map_err(|wrong: Wrong| wrong.at(&entry.place, &entry.node).under(key))
    }

    fn next_value_seed<V: DeserializeSeed<'a>>(&mut self, seed: V) -> Result<V::Value, Wrong<'a>> {
        let (key, Entry { node, .. }) = self.last.expect("serde asks for a value after its key");
        seed.deserialize(node).map_err(|wrong| wrong.at(&node.place, node).under(key))
    }
}

/// The one key of a table, which says what kind of thing it holds.
#[derive(Clone, Copy)]
struct Choice<'a> {
    key: &'a String,
    entry: &'a Entry,
}

impl<'a> Choice<'a> {
    fn read<T>(self, read: impl FnOnce(&'a Node) -> Result<T, Wrong<'a>>) -> Result<T, Wrong<'a>> {
        let node = &self.entry.node;
        read(node).map_err(|wrong| wrong.at(&node.place, node).under(self.key))
    }
}

impl<'a> EnumAccess<'a> for Choice<'a> {
    type Error = Wrong<'a>;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'a>>(self, seed: V) -> Result<(V::Value, Self), Wrong<'a>> {
        let read = seed.deserialize(BorrowedStrDeserializer::new(self.key));
        let word = read.map_err(|wrong: Wrong| wrong.at(&self.entry.place, &self.entry.node).under(self.key))?;
        Ok((word, self))
    }
}

impl<'a> VariantAccess<'a> for Choice<'a> {
    type Error = Wrong<'a>;

    fn unit_variant(self) -> Result<(), Wrong<'a>> {
        self.read(<()>::deserialize)
    }

    fn newtype_variant_seed<T: DeserializeSeed<'a>>(self, seed: T) -> Result<T::Value, Wrong<'a>> {
        self.read(|node| seed.deserialize(node))
    }

    fn tuple_variant<V: Visitor<'a>>(self, length: usize, visitor: V) -> Result<V::Value, Wrong<'a>> {
        self.read(|node| node.deserialize_tuple(length, visitor))
    }

    /// A table, and never a list of its values in their order.
    fn struct_variant<V: Visitor<'a>>(self, fields: Words, visitor: V) -> Result<V::Value, Wrong<'a>> {
        self.read(|node| match &node.value {
            Value::Table(_) => node.deserialize_map(visitor),
            _ => Err(Wrong::custom(format!("wanted the table {{ {} }}", fields.join(", ")))),
        })
    }
}

struct Items<'a>(Enumerate<slice::Iter<'a, Node>>);

impl<'a> SeqAccess<'a> for Items<'a> {
    type Error = Wrong<'a>;

    fn next_element_seed<T: DeserializeSeed<'a>>(&mut self, seed: T) -> Result<Option<T::Value>, Wrong<'a>> {
        let Some((index, item)) = self.0.next() else { return Ok(None) };
        seed.deserialize(item).map(Some).map_err(|wrong| wrong.under(&index.to_string()))
    }
}
