// How the yield stress of metals grows with the equivalent plastic strain k: sY(k) = s0 + B k^n.
// Twin: src/material/hardening.rs
#import params

// Rounds of Newton's method of `increment`.
const HARDENING_ROUNDS: u32 = 8u;

struct Yield {
    stress: real,
    slope: real,
}

// k^n, k not negative.
fn power_of(k: real, exponent: real) -> real {
    if k > 0.0 {
        return exp(exponent * log(k));
    }
    return 0.0;
}

// sY(k) and its slope; the slope of a power at k = 0 is infinite, and here 0.
fn yield_stress(body: Body, k: real) -> Yield {
    if body.hardening_exponent == 1.0 {
        return Yield(body.yield_stress + body.hardening * k, body.hardening);
    }
    let grown = body.hardening * power_of(k, body.hardening_exponent);
    if k > 0.0 {
        return Yield(body.yield_stress + grown, body.hardening_exponent * grown / k);
    }
    return Yield(body.yield_stress + grown, 0.0);
}

// d of trial - stiffness d = sY(k + d). The trial stress is above sY(k).
fn increment(body: Body, trial: real, k: real, stiffness: real) -> real {
    let now = yield_stress(body, k);
    if body.hardening_exponent == 1.0 {
        return (trial - now.stress) / (stiffness + now.slope);
    }
    let inverse = 1.0 / body.hardening_exponent;
    // In x = (k + d)^n the residual is concave: Newton's method comes down to the root from any x above, such as
    // the roots for stiffness 0 and for no hardening.
    var x = min(power_of(k + (trial - now.stress) / stiffness, body.hardening_exponent),
        (trial - body.yield_stress) / body.hardening);
    for (var round = 0u; round < HARDENING_ROUNDS; round++) {
        let grown = power_of(x, inverse);
        let residual = trial - body.yield_stress - body.hardening * x - stiffness * (grown - k);
        x += residual / (body.hardening + stiffness * inverse * grown / x);
    }
    // Where d is small beside k it has its digits from steps of its own.
    var d = power_of(x, inverse) - k;
    for (var round = 0u; round < 2u; round++) {
        let at = yield_stress(body, k + d);
        d = max(d + (trial - at.stress - stiffness * d) / (stiffness + at.slope), 0.0);
    }
    return d;
}
