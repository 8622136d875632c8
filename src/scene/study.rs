//! What a scene says about its own studies.

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;
use std::fmt;

/// Override paths in quotes, and the values that each takes: `"time.cfl" = [0.2, 0.4]`.
pub type Group = BTreeMap<String, Vec<toml::Value>>;

/// Groups whose settings stand in one study, each the product of its own axes.
#[derive(Debug, Clone)]
pub enum Groups {
    One([Group; 1]),
    Many(Vec<Group>),
}

impl Groups {
    pub fn list(&self) -> &[Group] {
        match self {
            Self::One(one) => one,
            Self::Many(many) => many,
        }
    }

    /// Whether it was typed as a table, not as a list of them.
    pub fn one(&self) -> bool {
        matches!(self, Self::One(_))
    }
}

/// By hand, since serde's untagged enums do not say which key is at fault.
impl<'de> Deserialize<'de> for Groups {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TableOrList;
        impl<'de> Visitor<'de> for TableOrList {
            type Value = Groups;

            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("a map")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Groups, A::Error> {
                Group::deserialize(MapAccessDeserializer::new(map)).map(|group| Groups::One([group]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Groups, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(list)).map(Groups::Many)
            }
        }
        deserializer.deserialize_any(TableOrList)
    }
}
