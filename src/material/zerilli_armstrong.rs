//! Strength of metals by the motion of dislocations, Zerilli & Armstrong 1987: with k the equivalent plastic strain, r its
//! rate over a reference rate and T the temperature,
//!
//! s = c0 + (c1 + c2 sqrt k) exp(-c3 T + c4 T ln r) + c5 k^n;
//!
//! c1 = c5 = 0 for copper and other face-centred metals, c2 = 0 for iron and other body-centred ones. The constants hold
//! from about 1e-3 to 1e5 per second, and from room temperature to about two thirds of the melting point.
//! Twin: shaders/material/zerilli_armstrong.wgsl

use super::j2::power;
use super::point::{Flow, Point};
use crate::rows::Body;
use crate::tensor::Real;

super::law::law! {
    ZerilliArmstrong, zerilli_armstrong, Strength, "metals by the motion of dislocations: harden with the rate, soften with heat";
    reads: [Rate, Temperature], remembers: [InelasticStrain, EquivalentPlasticStrain];
    c0: STRESS, Range::NotNegative, Some(0.0), 0.02, "stress that neither heat nor rate changes";
    c1: STRESS, Range::NotNegative, Some(0.0), 0.05, "stress that does not depend on the strain, before heat lowers it";
    c2: STRESS, Range::NotNegative, Some(0.0), 0.1, "what multiplies the root of the strain, before heat lowers it";
    c3: INVERSE_TEMPERATURE, Range::NotNegative, Some(0.0), 0.7, "how fast it falls with the temperature";
    c4: INVERSE_TEMPERATURE, Range::NotNegative, Some(0.0), 0.03, "how fast it falls with the temperature at lower rates";
    c5: STRESS, Range::NotNegative, Some(0.0), 0.03, "what multiplies the power n of the strain";
    n: NONE, Range::UpTo(0.0, 1.0), Some(1.0), 0.5, "that power";
    reference_rate: RATE, Range::Positive, Some(1.0), 1.0, "rate whose logarithm is zero: one per second";
}

#[inline(always)]
pub fn flow<R: Real>(body: &Body<R>, at: &Point<R>) -> Flow<R> {
    let (own, zero) = (ZerilliArmstrong::of(body), R::of(0.0));
    let (root, growing) = (at.strain.sqrt(), at.strain > zero);
    // At rest nothing is left of it, unless the rate does not matter.
    let ratio = at.rate / own.reference_rate;
    let fast = own.c4 * at.temperature;
    let slowed = if fast > zero { power(ratio, fast) } else { R::of(1.0) };
    let thermal = (zero - own.c3 * at.temperature).exp() * slowed;
    let by_strain = if growing { own.c2 * R::of(0.5) / root * thermal } else { zero };
    let athermal = own.c5 * power(at.strain, own.n);
    let hardening = if growing { own.n * athermal / at.strain } else { zero };
    let grown = (own.c1 + own.c2 * root) * thermal;
    let by_rate = if at.rate > zero { fast * grown / at.rate } else { zero };
    Flow { stress: own.c0 + grown + athermal, by_strain: by_strain + hardening, by_rate }
}
