// Quadratic kernel of Johnson 1996. Twin: src/smoothing/quadratic.rs
fn shape(q: real) -> real {
    let outer = max(2.0 - q, 0.0);
    return 0.1875 * outer * outer;
}
fn slope(q: real) -> real {
    return -0.375 * max(2.0 - q, 0.0);
}
