// Strength of metals that harden: s0 + B k^n, k the equivalent plastic strain. Twin: src/material/j2.rs
#import flow

// At k = 0 the slope of a power is infinite and 0 stands for it: see src/material/j2.rs.
fn flow_j2(body: Body, at: Point) -> Flow {
    let own = j2_of(body);
    if own.hardening_exponent == 1.0 {
        return Flow(own.yield_stress + own.hardening * at.strain, own.hardening, 0.0);
    }
    let grown = own.hardening * power_of(at.strain, own.hardening_exponent);
    if at.strain > 0.0 {
        return Flow(own.yield_stress + grown, own.hardening_exponent * grown / at.strain, 0.0);
    }
    return Flow(own.yield_stress + grown, 0.0, 0.0);
}
