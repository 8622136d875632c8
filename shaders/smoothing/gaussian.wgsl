// Gaussian cut at q = 2. Twin: src/smoothing/gaussian.rs
fn shape(q: real) -> real {
    return select(0.0, exp(-q * q), q < 2.0);
}
fn slope(q: real) -> real {
    return select(0.0, -2.0 * q * exp(-q * q), q < 2.0);
}
