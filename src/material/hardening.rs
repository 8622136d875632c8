//! How the yield stress of metals grows with the equivalent plastic strain k: sY(k) = s0 + B k^n, Ludwik 1909; perfect
//! plasticity where B is 0, linear hardening where n is 1.
//! Twin: shaders/material/hardening.wgsl

use crate::rows::Body;
use crate::tensor::Real;

/// Rounds of Newton's method of [`increment`], after which d has all digits.
const ROUNDS: usize = 8;

/// k^n, k not negative: as the shader must find it.
#[inline(always)]
fn power<R: Real>(k: R, exponent: R) -> R {
    if k > R::of(0.0) { (exponent * k.ln()).exp() } else { R::of(0.0) }
}

/// sY(k) and its slope; the slope of a power at k = 0 is infinite, and here 0.
#[inline(always)]
pub fn yield_stress<R: Real>(body: &Body<R>, k: R) -> (R, R) {
    if body.hardening_exponent == R::of(1.0) {
        return (body.yield_stress + body.hardening * k, body.hardening);
    }
    let grown = body.hardening * power(k, body.hardening_exponent);
    let slope = if k > R::of(0.0) { body.hardening_exponent * grown / k } else { R::of(0.0) };
    (body.yield_stress + grown, slope)
}

/// Growth d of the equivalent plastic strain by which the yield stress meets a Mises stress that falls with it:
/// trial - stiffness d = sY(k + d). The trial stress is above sY(k).
#[inline(always)]
pub fn increment<R: Real>(body: &Body<R>, trial: R, k: R, stiffness: R) -> R {
    let (mut now, slope) = yield_stress(body, k);
    let mut d = (trial - now) / (stiffness + slope);
    if body.hardening_exponent == R::of(1.0) {
        return d;
    }
    let inverse = R::of(1.0) / body.hardening_exponent;
    // In x = (k + d)^n the residual is concave: Newton's method comes down to the root from any x above, such as the
    // roots for stiffness 0 and for no hardening. In d it would crawl where n is small.
    let mut x = power(k + (trial - now) / stiffness, body.hardening_exponent)
        .min((now - body.yield_stress + trial - now) / body.hardening);
    for _ in 0..ROUNDS {
        let grown = power(x, inverse);
        let residual = trial - body.yield_stress - body.hardening * x - stiffness * (grown - k);
        x += residual / (body.hardening + stiffness * inverse * grown / x);
    }
    // Where d is small beside k it has its digits from a last step of its own.
    d = power(x, inverse) - k;
    for _ in 0..2 {
        let (at, slope) = yield_stress(body, k + d);
        now = at;
        d = (d + (trial - now - stiffness * d) / (stiffness + slope)).max(R::of(0.0));
    }
    d
}
