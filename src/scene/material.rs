//! A material: as typed, by the keys that the laws declare; and what becomes of it, the laws of its roles with their
//! numbers.
//!
//! `law = "j2"` beside its numbers is the short form of `strength = { j2 = { … } }` with the pressure of the formulation.

use crate::material::{self, Law, NUMBERS, Number, Point, Reads, Role};
use crate::method::Formulation;
use crate::rows::Body;
use serde::de::{DeserializeSeed, Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::LazyLock;

/// `[material.NAME]`: density, moduli, and the numbers of a law by its short form; or a law for each role.
#[derive(Debug, Clone, Default)]
pub struct MaterialTable {
    /// Word of the short form.
    pub law: Option<String>,
    pub roles: BTreeMap<String, RoleTable>,
    pub numbers: BTreeMap<String, f64>,
}

/// The law of one role, with its numbers: `{ j2 = { yield_stress = 1.0 } }`, or its word alone.
#[derive(Debug, Clone)]
pub struct RoleTable {
    pub law: String,
    pub numbers: BTreeMap<String, f64>,
}

/// The stress that hardening adds to the yield stress of `j2` at the equivalent plastic strain k.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Hardening {
    /// A modulus (stress), times k.
    Linear(f64),
    /// coefficient k^exponent
    Power { coefficient: f64, exponent: f64 },
}

/// Number of the law `j2` that has no key of its own: it is typed as `exponent` inside `hardening`.
const EXPONENT: &str = "hardening_exponent";
const HARDENING: &str = "hardening";
/// Word of the short form for a material that has a pressure and no strength.
const FLUID: &str = "fluid";
const MODULI: [&str; 4] = ["youngs_modulus", "poisson_ratio", "bulk_modulus", "shear_modulus"];

fn leaked(words: impl Iterator<Item = &'static str>) -> &'static [&'static str] {
    let mut list: Vec<&str> = Vec::new();
    words.for_each(|word| {
        if !list.contains(&word) {
            list.push(word)
        }
    });
    Vec::leak(list)
}

fn own(law: Law) -> impl Iterator<Item = &'static str> {
    law.declaration().numbers.iter().map(|number| number.key).filter(|key| *key != EXPONENT)
}

/// Laws that the short form names, beside [`FLUID`].
fn short() -> impl Iterator<Item = Law> {
    Law::of_role(Role::Strength).chain(Law::of_role(Role::Whole))
}

static WORDS: LazyLock<&[&str]> = LazyLock::new(|| leaked(short().map(Law::word).chain([FLUID])));
static KEYS: LazyLock<&[&str]> = LazyLock::new(|| {
    let roles = Role::ALL.map(Role::word);
    leaked(roles.into_iter().chain(["density"]).chain(MODULI).chain(short().flat_map(own)))
});
static KEYS_OF_LAWS: LazyLock<Vec<&[&str]>> = LazyLock::new(|| {
    let modulus = |law: Law| match law.role() {
        Role::Pressure => Some("bulk_modulus"),
        Role::Strength => Some("shear_modulus"),
        _ => None,
    };
    Law::ALL.iter().map(|&law| leaked(own(law).chain(modulus(law)))).collect()
});
static WORDS_OF_ROLES: LazyLock<Vec<&[&str]>> =
    LazyLock::new(|| Role::ALL.iter().map(|&role| leaked(Law::of_role(role).map(Law::word))).collect());

/// Reads the next value of a map into the numbers, under its key. `hardening` makes two numbers, factor and exponent.
fn number<'de, A: MapAccess<'de>>(map: &mut A, key: &str, numbers: &mut BTreeMap<String, f64>) -> Result<(), A::Error> {
    if key != HARDENING {
        numbers.insert(key.into(), map.next_value()?);
        return Ok(());
    }
    let [coefficient, exponent] = match map.next_value()? {
        Hardening::Linear(modulus) => [modulus, 1.0],
        Hardening::Power { coefficient, exponent } => [coefficient, exponent],
    };
    numbers.insert(HARDENING.into(), coefficient);
    numbers.insert(EXPONENT.into(), exponent);
    Ok(())
}

/// Reads a key that must be one of these; the error is the key's own, so that it is told by its line.
struct Key(&'static [&'static str]);

impl<'de> DeserializeSeed<'de> for Key {
    type Value = String;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<String, D::Error> {
        let key = String::deserialize(deserializer)?;
        if self.0.contains(&key.as_str()) { Ok(key) } else { Err(D::Error::unknown_field(&key, self.0)) }
    }
}

impl<'de> Deserialize<'de> for MaterialTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Table;
        impl<'de> Visitor<'de> for Table {
            type Value = MaterialTable;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("struct MaterialTable")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<MaterialTable, A::Error> {
                let mut table = MaterialTable::default();
                while let Some(key) = map.next_key_seed(Key(*KEYS))? {
                    match Role::ALL.into_iter().find(|role| role.word() == key) {
                        Some(Role::Whole) => table.law = Some(map.next_value::<ShortWord>()?.0),
                        Some(role) => {
                            table.roles.insert(key, map.next_value_seed(OfRole(role))?);
                        }
                        None => number(&mut map, &key, &mut table.numbers)?,
                    }
                }
                if table.numbers.contains_key("density") { Ok(table) } else { Err(A::Error::missing_field("density")) }
            }
        }
        deserializer.deserialize_struct("MaterialTable", *KEYS, Table)
    }
}

/// A word of the short form.
struct ShortWord(String);

impl<'de> Deserialize<'de> for ShortWord {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        if WORDS.contains(&word.as_str()) { Ok(Self(word)) } else { Err(D::Error::unknown_variant(&word, *WORDS)) }
    }
}

/// Reads the law of a role.
struct OfRole(Role);

/// Reads the word of a law of a role.
struct WordOf(Role);

impl WordOf {
    fn law<E: Error>(&self, word: &str) -> Result<Law, E> {
        let place = Role::ALL.iter().position(|role| *role == self.0).unwrap_or_default();
        Law::named(self.0, word).ok_or_else(|| E::unknown_variant(word, WORDS_OF_ROLES[place]))
    }
}

impl<'de> DeserializeSeed<'de> for WordOf {
    type Value = Law;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Law, D::Error> {
        self.law(&String::deserialize(deserializer)?)
    }
}

impl<'de> DeserializeSeed<'de> for OfRole {
    type Value = RoleTable;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<RoleTable, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for OfRole {
    type Value = RoleTable;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a word or a table")
    }
    fn visit_str<E: Error>(self, word: &str) -> Result<RoleTable, E> {
        let law = WordOf(self.0).law::<E>(word)?;
        Ok(RoleTable { law: law.word().into(), numbers: BTreeMap::new() })
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RoleTable, A::Error> {
        let one = || A::Error::custom("wanted exactly 1 element");
        let law = map.next_key_seed(WordOf(self.0))?.ok_or_else(one)?;
        let numbers = map.next_value_seed(OfLaw(law))?;
        match map.next_key::<String>()? {
            Some(_) => Err(one()),
            None => Ok(RoleTable { law: law.word().into(), numbers }),
        }
    }
}

/// Reads the numbers of a law.
struct OfLaw(Law);

impl<'de> DeserializeSeed<'de> for OfLaw {
    type Value = BTreeMap<String, f64>;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for OfLaw {
    type Value = BTreeMap<String, f64>;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a map")
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let (known, mut numbers) = (KEYS_OF_LAWS[self.0 as usize], BTreeMap::new());
        while let Some(key) = map.next_key_seed(Key(known))? {
            number(&mut map, &key, &mut numbers)?;
        }
        Ok(numbers)
    }
}

impl MaterialTable {
    pub fn number(&self, key: &str) -> Option<f64> {
        self.numbers.get(key).copied()
    }

    /// Whether the material's table has the key `hardening`.
    pub fn hardens(&self) -> bool {
        self.numbers.contains_key(HARDENING)
    }

    /// The law of the short form, or of the strength; None for a fluid.
    pub fn named(&self) -> Option<Law> {
        match (self.law.as_deref(), self.roles.get(Role::Strength.word())) {
            (Some(word), _) => short().find(|law| law.word() == word),
            (None, Some(strength)) => Law::named(Role::Strength, &strength.law),
            // A pressure alone is a fluid's.
            (None, None) if self.roles.contains_key(Role::Pressure.word()) => None,
            (None, None) => Some(Law::Elastic),
        }
    }

    pub fn has_memory(&self) -> bool {
        self.named().is_some_and(Law::has_memory)
    }

    pub fn yields(&self) -> bool {
        self.named().is_some_and(Law::yields)
    }
}

/// What a body is made of: the laws of its roles, with their numbers.
#[derive(Debug, Clone)]
pub struct Material {
    pub density: f64,
    pub bulk_modulus: f64,
    pub shear_modulus: f64,
    pub whole: Option<Law>,
    pub pressure: Option<Law>,
    pub strength: Option<Law>,
    pub heat: Option<Law>,
    pub numbers: [f64; NUMBERS],
}

impl Material {
    /// # Errors
    /// What the material is or lacks, to follow its name.
    pub(super) fn resolve(typed: &MaterialTable, formulation: Formulation) -> Result<Self, String> {
        let named = |role: Role| typed.roles.get(role.word()).and_then(|table| Law::named(role, &table.law));
        if let (Some(word), Some(role)) = (&typed.law, typed.roles.keys().find(|role| *role != Role::Heat.word())) {
            return Err(format!("has the law `{word}` and beside it a {role}: name one of the two"));
        }
        let law = typed.named();
        let whole = law.filter(|law| law.role() == Role::Whole);
        let usual = if formulation == Formulation::Eulerian { Law::Linear } else { Law::HartmannNeff };
        let pressure = if whole.is_some() { None } else { Some(named(Role::Pressure).unwrap_or(usual)) };
        let strength = law.filter(|law| law.role() == Role::Strength);
        let heat = named(Role::Heat);
        let (bulk_modulus, shear_modulus) = moduli(typed, strength.is_none() && whole.is_none())?;
        let mut material = Self {
            density: positive(typed.number("density").unwrap_or(0.0), "density")?,
            bulk_modulus,
            shear_modulus,
            whole,
            pressure,
            strength,
            heat,
            numbers: [0.0; NUMBERS],
        };
        for law in material.laws() {
            material.fill(typed, law)?;
        }
        material.check(typed)?;
        Ok(material)
    }

    pub fn laws(&self) -> Vec<Law> {
        [self.whole, self.pressure, self.strength, self.heat].into_iter().flatten().collect()
    }

    pub fn has_memory(&self) -> bool {
        self.laws().into_iter().any(Law::has_memory)
    }

    pub fn yields(&self) -> bool {
        self.strength.is_some_and(Law::yields)
    }

    /// Whether the material flows on under any load, and so has no equilibrium.
    pub fn creeps(&self) -> bool {
        self.whole == Some(Law::Maxwell) || self.strength.is_some_and(|law| law.reads(Reads::Rate))
    }

    /// Puts the typed numbers of a law, or their defaults, into the places of its role.
    fn fill(&mut self, typed: &MaterialTable, law: Law) -> Result<(), String> {
        let apart = typed.roles.get(law.role().word());
        let given = apart.map_or(&typed.numbers, |table| &table.numbers);
        for (k, number) in law.declaration().numbers.iter().enumerate() {
            self.numbers[law.role().first() + k] = number_of(law, number, given.get(number.key).copied())?;
        }
        Ok(())
    }

    /// Refuses laws that do not go together, and numbers that no law of the material takes.
    fn check(&self, typed: &MaterialTable) -> Result<(), String> {
        let short = if typed.roles.contains_key(Role::Strength.word()) { None } else { self.whole.or(self.strength) };
        let takes = |law: Law, key: &str| law.declaration().numbers.iter().any(|number| number.key == key);
        for key in typed.numbers.keys().filter(|key| *key != "density" && !MODULI.contains(&key.as_str())) {
            if !short.is_some_and(|law| takes(law, key)) {
                let words = Law::ALL.iter().filter(|law| takes(**law, key)).map(|law| format!("`{}`", law.word()));
                let words: Vec<String> = words.collect();
                let (laws, take) = if words.len() == 1 { ("law", "takes") } else { ("laws", "take") };
                return Err(format!("has a {key}, which only the {laws} {} {take}", words.join(", ")));
            }
        }
        let warm = self.strength.is_some_and(|law| law.reads(Reads::Temperature));
        if let (true, None, Some(law)) = (warm, self.heat, self.strength) {
            return Err(format!(
                "has the strength `{}`, which depends on the temperature: it needs a heat, such as \
                 `heat = {{ isothermal = {{ temperature = 293 }} }}` or `{{ adiabatic = {{ temperature = 293, specific_heat = … }} }}`",
                law.word()
            ));
        }
        if self.heat.is_some() && !self.yields() {
            return Err("has a heat, but no strength that yields, so that no plastic work makes heat".into());
        }
        if self.yields() && self.row().yield_stress <= 0.0 {
            return Err("has a strength of 0 before any plastic flow: its numbers must give a yield stress above 0".into());
        }
        Ok(())
    }

    pub fn youngs_modulus(&self) -> f64 {
        9.0 * self.bulk_modulus * self.shear_modulus / (3.0 * self.bulk_modulus + self.shear_modulus)
    }

    /// The modulus by which contact is as stiff as its body: Young's, of a fluid that of its bulk.
    pub fn contact_modulus(&self) -> f64 {
        if self.shear_modulus > 0.0 { self.youngs_modulus() } else { self.bulk_modulus }
    }

    /// Speed of longitudinal waves.
    pub fn sound_speed(&self) -> f64 {
        ((self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus) / self.density).sqrt()
    }

    /// The material's part of a row in the table of bodies.
    pub fn row(&self) -> Body<f64> {
        let mut row = Body {
            density: self.density,
            bulk_modulus: self.bulk_modulus,
            shear_modulus: self.shear_modulus,
            youngs_modulus: self.youngs_modulus(),
            sound_speed: self.sound_speed(),
            numbers: self.numbers,
            ..Body::default()
        };
        for law in self.laws() {
            row = row.with(law, &[]);
        }
        if self.yields() {
            // Asked at a plastic strain rate of 1/time, since a strength that creeps may bear no stress at rest.
            let at = Point { strain: 0.0, rate: 1.0, temperature: self.temperature() };
            row.yield_stress = material::flow(&row, &at).stress;
        }
        row
    }

    /// Temperature at the start; 0 where there is none.
    pub fn temperature(&self) -> f64 {
        if self.heat.is_some() { self.numbers[Role::Heat.first()] } else { 0.0 }
    }
}

/// A number of a law, as given or else its default.
fn number_of(law: Law, number: &Number, given: Option<f64>) -> Result<f64, String> {
    let Some(value) = given.or(number.default) else {
        return Err(format!("has the law `{}`: it needs a {}", law.word(), number.key));
    };
    if number.range.holds(value) { Ok(value) } else { Err(format!("needs {}, found {value}", number.range.of(number.key))) }
}

fn positive(value: f64, what: &str) -> Result<f64, String> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(format!("needs a positive {what}, found {value}")) }
}

/// Bulk and shear modulus from the pair of constants that is typed, in the material or in the tables of its roles.
fn moduli(typed: &MaterialTable, fluid: bool) -> Result<(f64, f64), String> {
    positive(typed.number("density").unwrap_or(0.0), "density")?;
    let apart = |role: Role, key: &str| typed.roles.get(role.word()).and_then(|table| table.numbers.get(key).copied());
    let bulk = typed.number("bulk_modulus").or(apart(Role::Pressure, "bulk_modulus"));
    let shear = typed.number("shear_modulus").or(apart(Role::Strength, "shear_modulus"));
    match (typed.number("youngs_modulus"), typed.number("poisson_ratio"), bulk, shear) {
        (None, None, Some(k), None) if fluid => Ok((positive(k, "bulk_modulus")?, 0.0)),
        _ if fluid => Err("is a fluid: it needs bulk_modulus and no other modulus".into()),
        (Some(e), Some(nu), None, None) => {
            positive(e, "youngs_modulus")?;
            if !(nu > -1.0 && nu < 0.5) {
                return Err(format!("needs a poisson_ratio between -1 and 0.5, found {nu}"));
            }
            Ok((e / (3.0 * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu))))
        }
        (None, None, Some(k), Some(mu)) => Ok((positive(k, "bulk_modulus")?, positive(mu, "shear_modulus")?)),
        _ => Err("needs youngs_modulus with poisson_ratio, or bulk_modulus with shear_modulus, and nothing beside".into()),
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;

    /// What a scene with these lines for its metal says.
    fn said(lines: &str) -> String {
        let text = format!(
            "title = 't'\ndimension = 2\nspacing = 1.0\nduration = 1.0\n[[body]]\nname = 'b'\nmaterial = 'metal'\n\
             shape = {{ block = {{ min = [0, 0], max = [4, 4] }} }}\n[material.metal]\ndensity = 1.0\nyoungs_modulus = 1.0\n\
             poisson_ratio = 0.3\n{lines}\n"
        );
        Scene::parse(&text, "metal.toml", None, &[]).map_or_else(|error| error, |_| "good".into())
    }

    #[test]
    fn roles_and_the_short_form_give_the_same_material() {
        let short = "law = 'j2'\nyield_stress = 0.1\nhardening = { linear = 0.2 }";
        let apart = "pressure = 'linear'\nstrength = { j2 = { yield_stress = 0.1, hardening = { linear = 0.2 } } }";
        assert_eq!((said(short), said(apart)), ("good".into(), "good".into()));
        assert_eq!(said("strength = { j2 = { yield_stress = 0.1 } }\nheat = { isothermal = { temperature = 300 } }"), "good");
    }

    #[test]
    fn each_slip_is_told_by_its_line_in_one_sentence() {
        let cases = [
            ("strength = { j3 = {} }", "metal.toml:13: unknown word `j3` for `material.metal.strength`, did you mean `j2`?"),
            ("strength = { j2 = { yield_stres = 1 } }", "unknown key `yield_stres`, did you mean `yield_stress`?"),
            ("strength = { j2 = { yield_stress = 1 }, elastic = {} }", "must have exactly one key, found `elastic` and `j2`"),
            ("strength = { j2 = { yield_stress = 'x' } }", "yield_stress` must be a number, found a string"),
            ("strength = 3", "`material.metal.strength` must be a word or a table such as `{ j2 = { yield_stress = 0.1 } }`"),
            ("law = 'j2'\nstrength = 'elastic'", "has the law `j2` and beside it a strength: name one of the two"),
            ("strength = 'j2'", "has the law `j2`: it needs a yield_stress"),
            ("strength = { j2 = { yield_stress = nan } }", "needs a positive yield_stress, found NaN"),
            ("yield_stres = 1", "metal.toml:13: unknown key `yield_stres`, did you mean `yield_stress`?"),
            ("yield_stress = 1", "has a yield_stress, which only the law `j2` takes"),
            ("heat = { isothermal = { temperature = 300 } }", "has a heat"),
        ];
        for (lines, sentence) in cases {
            let said = said(lines);
            assert!(said.contains(sentence) && said.lines().count() == 1, "{lines}: {said}");
        }
    }
}
