// The state in which a strength is asked for the stress that it bears, and the answer. Twin: Point and Flow in
// src/material/point.rs
#import params

struct Point {
    // Equivalent plastic strain.
    strain: real,
    rate: real,
    temperature: real,
}

// A Mises stress, and its derivatives by the plastic strain and its rate.
struct Flow {
    stress: real,
    by_strain: real,
    by_rate: real,
}

// k^n, k not negative.
fn power_of(k: real, exponent: real) -> real {
    if k > 0.0 {
        return exp(exponent * log(k));
    }
    return 0.0;
}
