//! The stress with which a material answers a deformation: one file a law, and here the list of laws by their roles.
//!
//! A material has a law that is whole by itself, or a pressure and, if it resists a change of shape, a strength, and if
//! its strength asks for it, a heat. In the Eulerian formulation stress comes from rates: the mean stress from the
//! pressure, the deviator hypoelastic. In the Total Lagrangian it is the first Piola-Kirchhoff stress of H = F - 1,
//! written in H so that f32 keeps small strains. Where a strength yields, [`yielding`] finds how far. Twin: shaders/material/
//!
//! A new law is its pair of files, `src/material/x.rs` and `shaders/material/x.wgsl`, and its word in the list below.

pub mod inelastic;
pub mod law;
mod point;
pub mod stiffening;
pub mod strain;
pub mod yielding;

pub use law::{Declaration, NUMBERS, Number, Range, Reads, Role, unit_words};
pub use point::{Flow, Memory, Point};

use crate::rows::Body;
use crate::tensor::{Real, Space};

macro_rules! laws {
    (
        pressure: $($pressure:ident $Pressure:ident),*;
        strength: $($strength:ident $Strength:ident),*;
        heat: $($heat:ident $Heat:ident),*;
        whole: $($whole:ident $Whole:ident),*;
    ) => {
        $(pub mod $pressure;)* $(pub mod $strength;)* $(pub mod $heat;)* $(pub mod $whole;)*

        /// Names the laws. A body holds for each role [`Law::number`], which counts from 1, or 0 for none.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Law { $($Pressure,)* $($Strength,)* $($Heat,)* $($Whole,)* }

        impl Law {
            pub const ALL: &'static [Law] =
                &[$(Law::$Pressure,)* $(Law::$Strength,)* $(Law::$Heat,)* $(Law::$Whole,)*];
            pub fn declaration(self) -> &'static Declaration {
                match self {
                    $(Law::$Pressure => &$pressure::LAW,)* $(Law::$Strength => &$strength::LAW,)*
                    $(Law::$Heat => &$heat::LAW,)* $(Law::$Whole => &$whole::LAW,)*
                }
            }
        }

        /// Mean Kirchhoff stress -J p of a material made of roles, from J - 1.
        #[inline(always)]
        pub fn kirchhoff<R: Real>(body: &Body<R>, volume_change: R) -> R {
            match body.pressure {
                $(number if number == Law::$Pressure.number() => $pressure::kirchhoff(body, volume_change),)*
                _ => R::of(0.0),
            }
        }

        /// Elastic energy per reference volume of a material made of roles, of its change of volume J - 1.
        pub fn stored_in_volume<R: Real>(body: &Body<R>, volume_change: R) -> R {
            match body.pressure {
                $(number if number == Law::$Pressure.number() => $pressure::stored(body, volume_change),)*
                _ => R::of(0.0),
            }
        }

        /// The Mises stress that a strength bears at a point, with its derivatives.
        #[inline(always)]
        pub fn flow<R: Real>(body: &Body<R>, at: &Point<R>) -> Flow<R> {
            match body.strength {
                $(number if number == Law::$Strength.number() => $strength::flow(body, at),)*
                _ => Flow { stress: R::of(0.0), by_strain: R::of(0.0), by_rate: R::of(0.0) },
            }
        }

        /// By how much plastic work, per reference volume, raises the temperature.
        #[inline(always)]
        pub fn rise<R: Real>(body: &Body<R>, work: R) -> R {
            match body.heat {
                $(number if number == Law::$Heat.number() => $heat::rise(body, work),)*
                _ => R::of(0.0),
            }
        }
    };
}

laws! {
    pressure: linear Linear, hartmann_neff HartmannNeff;
    strength: elastic Elastic, j2 J2, zerilli_armstrong ZerilliArmstrong;
    heat: isothermal Isothermal, adiabatic Adiabatic;
    whole: st_venant_kirchhoff StVenantKirchhoff, neo_hookean NeoHookean, maxwell Maxwell;
}

impl Law {
    /// What a body holds for a role that this law fills.
    pub const fn number(self) -> u32 {
        self as u32 + 1
    }
    /// Word in scenes, and stem of the law's files.
    pub fn word(self) -> &'static str {
        self.declaration().word
    }
    pub fn role(self) -> Role {
        self.declaration().role
    }
    pub fn about(self) -> &'static str {
        self.declaration().about
    }
    /// Law of a role by its word.
    pub fn named(role: Role, word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|law| law.role() == role && law.word() == word)
    }
    pub fn of_role(role: Role) -> impl Iterator<Item = Self> {
        Self::ALL.iter().copied().filter(move |law| law.role() == role)
    }
    /// Whether stress depends on more than the present deformation.
    pub fn has_memory(self) -> bool {
        self.role() != Role::Heat && !self.declaration().remembers.is_empty()
    }
    /// Whether the law is a strength that yields.
    pub fn yields(self) -> bool {
        self.role() == Role::Strength && self.has_memory()
    }
    pub fn reads(self, what: Reads) -> bool {
        self.declaration().reads.contains(&what)
    }
}

impl<R: Real> Body<R> {
    /// The same body with a law in the law's role, and the law's numbers in the order of their declaration.
    pub fn with(mut self, law: Law, numbers: &[R]) -> Self {
        let place = match law.role() {
            Role::Whole => &mut self.whole,
            Role::Pressure => &mut self.pressure,
            Role::Strength => &mut self.strength,
            Role::Heat => &mut self.heat,
        };
        *place = law.number();
        self.numbers[law.role().first()..][..numbers.len()].copy_from_slice(numbers);
        self
    }

    /// The same numbers in another precision.
    pub fn map<T: Real>(&self, real: impl Fn(R) -> T) -> Body<T> {
        Body {
            whole: self.whole,
            pressure: self.pressure,
            strength: self.strength,
            heat: self.heat,
            density: real(self.density),
            bulk_modulus: real(self.bulk_modulus),
            shear_modulus: real(self.shear_modulus),
            youngs_modulus: real(self.youngs_modulus),
            yield_stress: real(self.yield_stress),
            sound_speed: real(self.sound_speed),
            smoothing_length: real(self.smoothing_length),
            frequency: real(self.frequency),
            numbers: self.numbers.map(real),
        }
    }
}

const NEO_HOOKEAN: u32 = Law::NeoHookean.number();
const MAXWELL: u32 = Law::Maxwell.number();
const ST_VENANT_KIRCHHOFF: u32 = Law::StVenantKirchhoff.number();

/// First Piola-Kirchhoff stress of the deformation 1 + H. `memory` is the inelastic strain C_i - 1 of a material that
/// remembers. The shaders' twins of [`first_piola`], [`relax`] and [`dissipated`] are no files: `src/backend/shader/laws.rs`
/// writes their text for the laws of the scene.
#[inline(always)]
pub fn first_piola<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Mat {
    match body.whole {
        ST_VENANT_KIRCHHOFF => st_venant_kirchhoff::first_piola::<S>(body, h),
        NEO_HOOKEAN => neo_hookean::first_piola::<S>(body, h),
        MAXWELL => maxwell::first_piola::<S>(body, h, memory),
        _ => inelastic::first_piola::<S>(body, h, memory, kirchhoff(body, strain::volume_change::<S>(h))),
    }
}

/// By how much the deformation 1 + H has raised the largest stiffness against plane waves; see [`stiffening`]. Written for the
/// laws of a scene by `src/backend/shader/laws.rs`, as [`first_piola`].
#[inline(always)]
pub fn stiffening<S: Space>(body: &Body<S::Real>, h: S::Mat) -> S::Real {
    let change = strain::volume_change::<S>(h);
    let denser = stiffening::denser(change);
    match body.whole {
        ST_VENANT_KIRCHHOFF => stiffening::by_stretch::<S>(h),
        0 => stiffening::by_volume::<S>(body, h, kirchhoff(body, change), kirchhoff(body, denser)),
        _ => {
            let mean = |change| hartmann_neff::volumetric_stress(body.bulk_modulus, change);
            stiffening::by_volume::<S>(body, h, mean(change), mean(denser))
        }
    }
}

/// Memory after a step that ends at the deformation 1 + H.
#[inline(always)]
pub fn relax<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: Memory<S>, step: S::Real) -> Memory<S> {
    match body.whole {
        MAXWELL => maxwell::relax::<S>(body, h, memory, step),
        0 => yielding::relax::<S>(body, h, memory, step),
        _ => memory,
    }
}

/// Heat of one step, plastic work included, per reference volume, from H and the inelastic strain before and after it.
#[inline(always)]
pub fn dissipated<S: Space>(body: &Body<S::Real>, before: (S::Mat, S::Sym), after: (S::Mat, S::Sym)) -> S::Real {
    if body.whole == MAXWELL || body.whole == 0 { inelastic::dissipated::<S>(body, before, after) } else { S::Real::of(0.0) }
}

/// Elastic energy per reference volume of the deformation 1 + H.
pub fn stored_energy<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Real {
    match body.whole {
        ST_VENANT_KIRCHHOFF => st_venant_kirchhoff::stored_energy::<S>(body, h),
        NEO_HOOKEAN => neo_hookean::stored_energy::<S>(body, h),
        MAXWELL => maxwell::stored_energy::<S>(body, h, memory),
        _ => inelastic::isochoric_energy::<S>(body, h, memory) + stored_in_volume(body, strain::volume_change::<S>(h)),
    }
}

/// True stress P F^T/J.
pub fn cauchy<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Sym {
    let one = S::Real::of(1.0);
    let kirchhoff = S::mat_mat(first_piola::<S>(body, h, memory), S::transpose(S::mat_identity() + h));
    S::sym_part(kirchhoff) * (one / (one + strain::volume_change::<S>(h)))
}

/// Pressure of a material made of roles at a volumetric strain.
#[inline(always)]
pub fn pressure<R: Real>(body: &Body<R>, volumetric_strain: R) -> R {
    -kirchhoff(body, volumetric_strain) / (R::of(1.0) + volumetric_strain)
}

/// 2 mu (D - tr D/3), Fuller (2.40); plane strain and uniaxial strain keep the third of the trace that the
/// missing axes carry.
#[inline(always)]
pub fn deviatoric_rate<S: Space>(shear_modulus: S::Real, velocity_gradient: S::Mat) -> S::Sym {
    let third = S::trace(velocity_gradient) * S::Real::of(1.0 / 3.0);
    (S::sym_part(velocity_gradient) - S::diagonal(third)) * (S::Real::of(2.0) * shear_modulus)
}

/// Elastic energy of the Eulerian formulation per reference volume: that of the volume, and S:S/(4 mu) (1 + e), the
/// full S:S in three dimensions.
pub fn elastic_energy(body: &Body<f64>, volumetric_strain: f64, deviator_square: f64) -> f64 {
    let mu = body.shear_modulus;
    let deviatoric = if mu > 0.0 { deviator_square / (4.0 * mu) } else { 0.0 };
    stored_in_volume(body, volumetric_strain) + deviatoric * (1.0 + volumetric_strain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_law_fits_into_its_room_and_declares_numbers_in_range() {
        for law in Law::ALL {
            let declared = law.declaration();
            assert!(declared.numbers.len() <= law.role().room(), "{}", law.word());
            assert!(law.role().first() + law.role().room() <= NUMBERS);
            for number in declared.numbers {
                let values = number.default.into_iter().chain([number.sample]);
                assert!(values.into_iter().all(|value| number.range.holds(value)), "{} {}", law.word(), number.key);
            }
            let known = declared.reads.iter().all(|_| law.role() == Role::Strength);
            assert!(known, "{} is no strength and reads", law.word());
        }
    }
}
