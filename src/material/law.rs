//! The declaration of a law. Each law declares in its own file its word and role, the numbers that it takes, and what it reads
//! of a particle and remembers. From the declaration follow the keys of a scene and the sentences of their errors, the table
//! of numbers, the structure in WGSL, the fields, `lithosph list` and the samples that the parity tests take.

use crate::fields::Field;

/// The part of a material that a law describes. A material has either a law that is whole by itself, or one law for each role
/// that it needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// Stress from the deformation gradient, by itself.
    Whole,
    /// The mean stress from the change of volume: equation of state.
    Pressure,
    /// What resists a change of shape, and the stress at which it yields.
    Strength,
    /// How the temperature changes.
    Heat,
}

impl Role {
    pub const ALL: [Role; 4] = [Role::Whole, Role::Pressure, Role::Strength, Role::Heat];
    /// Key of a material that names a law of this role.
    pub const fn word(self) -> &'static str {
        match self {
            Role::Whole => "law",
            Role::Pressure => "pressure",
            Role::Strength => "strength",
            Role::Heat => "heat",
        }
    }
    /// Place of the role's first number in a body's table.
    pub const fn first(self) -> usize {
        match self {
            Role::Whole | Role::Pressure => 0,
            Role::Strength => 8,
            Role::Heat => 28,
        }
    }
    /// Most numbers of a law of this role.
    pub const fn room(self) -> usize {
        match self {
            Role::Whole => 28,
            Role::Pressure => 8,
            Role::Strength => 20,
            Role::Heat => 4,
        }
    }
}

/// Numbers of its laws that a body has room for.
pub const NUMBERS: usize = 32;

/// Exponents of length, mass, time and temperature in a number's unit.
pub type Dimensions = [i8; 4];
pub const NONE: Dimensions = [0; 4];
pub const STRESS: Dimensions = [-1, 1, -2, 0];
pub const VISCOSITY: Dimensions = [-1, 1, -1, 0];
pub const RATE: Dimensions = [0, 0, -1, 0];
pub const TEMPERATURE: Dimensions = [0, 0, 0, 1];
pub const INVERSE_TEMPERATURE: Dimensions = [0, 0, 0, -1];
pub const SPECIFIC_HEAT: Dimensions = [2, 0, -2, -1];

/// A unit in words that hold in any system of units: "stress", "1/time".
pub fn unit_words(dimensions: Dimensions) -> &'static str {
    match dimensions {
        NONE => "1",
        STRESS => "stress",
        VISCOSITY => "stress time",
        RATE => "1/time",
        TEMPERATURE => "temperature",
        INVERSE_TEMPERATURE => "1/temperature",
        SPECIFIC_HEAT => "energy/(mass temperature)",
        _ => unreachable!("every unit of a declaration has its words"),
    }
}

/// What a number may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    Positive,
    NotNegative,
    /// Above the first, up to the second.
    UpTo(f64, f64),
}

impl Range {
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Range::Positive => value > 0.0,
                Range::NotNegative => value >= 0.0,
                Range::UpTo(low, high) => value > low && value <= high,
            }
    }
    /// "a positive yield_stress"
    pub fn of(self, key: &str) -> String {
        match self {
            Range::Positive => format!("a positive {key}"),
            Range::NotNegative => format!("a {key} that is not negative"),
            Range::UpTo(low, high) => format!("a {key} above {low} and up to {high}"),
        }
    }
}

/// A number that a law takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    pub key: &'static str,
    pub dimensions: Dimensions,
    pub range: Range,
    /// The value where a scene gives none; None for a number that a scene must give.
    pub default: Option<f64>,
    /// The value in tests, in which Young's modulus, the density, the spacing and the temperature are 1.
    pub sample: f64,
    pub about: &'static str,
}

/// The state, beside the equivalent plastic strain, on which a strength depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reads {
    /// Rate of the equivalent plastic strain: such a strength creeps, so that a body has no equilibrium.
    Rate,
    Temperature,
}

/// All that the rest of the code knows of a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Declaration {
    pub word: &'static str,
    pub role: Role,
    pub about: &'static str,
    pub numbers: &'static [Number],
    pub reads: &'static [Reads],
    /// Fields that keep from step to step what the law must know.
    pub remembers: &'static [Field],
    /// Name of the structure of numbers in WGSL.
    pub structure: &'static str,
    /// The shader twin's source.
    pub source: &'static str,
}

/// Declares a law: its structure of numbers and the constant `LAW`.
macro_rules! law {
    (
        $Name:ident, $word:ident, $role:ident, $about:literal;
        reads: [$($reads:ident),*], remembers: [$($field:ident),*];
        $($key:ident: $dimensions:ident, $range:expr, $default:expr, $sample:literal, $sentence:literal;)*
    ) => {
        #[doc = concat!("Numbers of the law `", stringify!($word), "`.")]
        #[derive(Debug, Clone, Copy)]
        pub struct $Name<R> { $(#[doc = $sentence] pub $key: R,)* kind: std::marker::PhantomData<R> }

        impl<R: crate::tensor::Real> $Name<R> {
            /// The law's numbers, as a body that has this law holds them.
            #[inline(always)]
            #[allow(unused_mut, unused_variables, unused_assignments)]
            pub fn of(body: &crate::rows::Body<R>) -> Self {
                let mut place = $crate::material::law::Role::$role.first();
                $(let $key = body.numbers[place]; place += 1;)*
                Self { $($key,)* kind: std::marker::PhantomData }
            }
        }

        pub const LAW: $crate::material::law::Declaration = {
            #[allow(unused_imports)]
            use $crate::material::law::{Declaration, NONE, Number, RATE, Range, Reads, Role};
            #[allow(unused_imports)]
            use $crate::material::law::{INVERSE_TEMPERATURE, SPECIFIC_HEAT, STRESS, TEMPERATURE, VISCOSITY};
            Declaration {
                word: stringify!($word),
                role: Role::$role,
                about: $about,
                numbers: &[$(Number {
                    key: stringify!($key),
                    dimensions: $dimensions,
                    range: $range,
                    default: $default,
                    sample: $sample,
                    about: $sentence,
                }),*],
                reads: &[$(Reads::$reads),*],
                remembers: &[$($crate::fields::Field::$field),*],
                structure: stringify!($Name),
                source: include_str!(concat!("../../shaders/material/", stringify!($word), ".wgsl")),
            }
        };
    };
}
pub(super) use law;
