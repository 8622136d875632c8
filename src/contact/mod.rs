//! Contact between surfaces: what two particles that were no neighbours do to each other when they come close.
//! Twin: shaders/contact/
//!
//! A scene chooses a law for each pair of bodies. Most laws are central pair potentials U = strength phi(r/range),
//! zero from the range on. A force derived from one keeps energy, momentum and angular momentum; see each law's file
//! for what it is good for. Beside them [`colour_field`], an energy of many particles, keeps the same. Fuller's [`zones`]
//! push along estimated normals and have no energy: they are here to show what that loses.

mod barrier;
pub mod colour_field;
mod power;
mod quadratic;
pub mod repulsive;
pub mod zones;

use crate::tensor::Real;
use serde::Deserialize;

macro_rules! potentials {
    ($($word:ident: $name:ident, $about:literal;)*) => {
        /// Names the pair potentials.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Potential { $($name),* }

        impl Potential {
            pub const ALL: &'static [Potential] = &[$(Potential::$name),*];
            /// Word in a scene, file stem.
            pub fn name(self) -> &'static str {
                match self { $(Potential::$name => stringify!($word)),* }
            }
            pub fn about(self) -> &'static str {
                match self { $(Potential::$name => $about),* }
            }
            /// The shader twin's source.
            pub fn source(self) -> &'static str {
                match self { $(Potential::$name => include_str!(concat!("../../shaders/contact/", stringify!($word), ".wgsl"))),* }
            }
            /// phi, -phi' and phi'' at q = r/range, 0 < q < 1.
            #[inline(always)]
            pub fn at<R: Real>(self, q: R, exponent: u32) -> (R, R, R) {
                match self { $(Potential::$name => $word::at(q, exponent)),* }
            }
        }
    };
}

potentials! {
    barrier: Barrier, "-(1 - q)^2 ln q: no energy suffices to bring two particles together";
    power: Power, "(1 - q)^2.5: the force grows with the power 1.5 of the overlap";
    quadratic: Quadratic, "(1 - q)^2: soft; with a range of several spacings, the most slippery on fitted surfaces";
    repulsive: Repulsive, "(W(r)/W(h))^(n + 1), 2h the range: Strand's repulsive force, finite where particles meet";
}

/// Laws beside the potentials: word in a scene, and what they do.
pub const OTHERS: [(&str, &str); 5] = [
    ("colour_field", "(k/2) sum V <c - c0>^2 of the other body's colour c: smooth over many particles"),
    ("zones", "Fuller's forces along estimated normals: keep momentum, neither energy nor angular momentum"),
    ("gap", "energy of a smoothed distance between exact surfaces, with friction: Total Lagrangian, see src/facet.rs"),
    ("none", "nothing acts between the two, and that is meant: they pass through each other without a warning"),
    (
        "tie",
        "no contact but a bond: bodies that share a face go on in each other, each of its own material: Total Lagrangian, see src/bond.rs",
    ),
];

/// The laws of contact that a scene names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Laws {
    /// Each once, in order of their numbers.
    pub potentials: Vec<Potential>,
    pub colour_field: bool,
    pub zones: Option<zones::Options>,
}

impl Laws {
    /// Some bodies touch.
    pub fn any(&self) -> bool {
        self.with_energy() || self.zones.is_some()
    }
    /// Some bodies touch by a law whose stiffness bounds the time step.
    pub fn stiffens(&self) -> bool {
        !self.potentials.is_empty()
    }
    /// Some bodies touch by a law that has an energy.
    pub fn with_energy(&self) -> bool {
        !self.potentials.is_empty() || self.colour_field
    }
}

/// Number of the law [`colour_field`] in the table of pairs. Twin: `shaders/lib/params.wgsl`
pub const COLOUR_FIELD: u32 = 100;
/// Number of the law [`zones`] in the table of pairs. Twin: `shaders/lib/params.wgsl`
pub const ZONES: u32 = 101;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_force_and_stiffness_is_a_derivative_of_its_potential_and_forces_end_smoothly() {
        for &potential in Potential::ALL {
            let at = |q: f64| potential.at(q, repulsive::EXPONENT);
            for k in 1..100 {
                let (q, step) = (k as f64 * 0.01, 1e-6);
                let difference = (at(q - step).0 - at(q + step).0) / (2.0 * step);
                let (energy, force, bend) = at(q);
                assert!((force - difference).abs() < 1e-6 * difference.max(1.0), "{potential:?} at {q}: {force} {difference}");
                let difference = (at(q - step).1 - at(q + step).1) / (2.0 * step);
                assert!(
                    (bend - difference).abs() < 2e-6 * difference.abs().max(1.0),
                    "{potential:?} at {q}: {bend} {difference}"
                );
                assert!(energy > 0.0 && force > 0.0);
            }
            let (energy, force, _) = at(1.0 - 1e-9);
            assert!(energy < 1e-17 && force < 1e-8);
        }
    }
}
