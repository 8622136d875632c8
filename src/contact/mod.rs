//! Contact between surfaces: what two particles that were no neighbours do to each other when they come close.
//! Twin: shaders/contact/
//!
//! Each law is a central pair potential U = strength phi(r/range), zero from the range on. A force derived from one
//! keeps energy, momentum and angular momentum; see each law's file for what it is good for.

mod barrier;
mod quadratic;

use crate::tensor::Real;
use serde::{Deserialize, Serialize};

macro_rules! potentials {
    ($($word:ident: $name:ident, $about:literal;)*) => {
        /// Names the pair potentials.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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
            /// phi and -phi' at q = r/range, 0 < q < 1.
            #[inline(always)]
            pub fn at<R: Real>(self, q: R) -> (R, R) {
                match self { $(Potential::$name => $word::at(q)),* }
            }
        }
    };
}

potentials! {
    barrier: Barrier, "-(1 - q)^2 ln q: no energy suffices to bring two particles together";
    quadratic: Quadratic, "(1 - q)^2: soft; with a range of several spacings, the most slippery on fitted surfaces";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_force_is_the_derivative_of_its_potential_and_ends_smoothly() {
        for &potential in Potential::ALL {
            for k in 1..100 {
                let (q, step) = (k as f64 * 0.01, 1e-6);
                let difference = (potential.at(q - step).0 - potential.at(q + step).0) / (2.0 * step);
                let (energy, force) = potential.at(q);
                assert!((force - difference).abs() < 1e-6 * difference.max(1.0), "{potential:?} at {q}: {force} {difference}");
                assert!(energy > 0.0 && force > 0.0);
            }
            let (energy, force) = potential.at(1.0 - 1e-9);
            assert!(energy < 1e-17 && force < 1e-8);
        }
    }
}
