// Strength of metals by the motion of dislocations, Zerilli & Armstrong 1987:
// s = c0 + (c1 + c2 sqrt k) exp(-c3 T + c4 T ln r) + c5 k^n. Twin: src/material/zerilli_armstrong.rs
#import flow

fn flow_zerilli_armstrong(body: Body, at: Point) -> Flow {
    let own = zerilli_armstrong_of(body);
    let root = sqrt(at.strain);
    // At rest nothing is left of it, unless the rate does not matter.
    let fast = own.c4 * at.temperature;
    var slowed: real = 1.0;
    if fast > 0.0 {
        slowed = power_of(at.rate / own.reference_rate, fast);
    }
    let thermal = exp(-own.c3 * at.temperature) * slowed;
    let grown = (own.c1 + own.c2 * root) * thermal;
    let athermal = own.c5 * power_of(at.strain, own.n);
    var by_strain: real = 0.0;
    if at.strain > 0.0 {
        by_strain = own.c2 * 0.5 / root * thermal + own.n * athermal / at.strain;
    }
    var by_rate: real = 0.0;
    if at.rate > 0.0 {
        by_rate = fast * grown / at.rate;
    }
    return Flow(own.c0 + grown + athermal, by_strain, by_rate);
}
