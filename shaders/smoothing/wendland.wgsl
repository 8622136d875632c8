// Quintic C2 kernel of Wendland 1995. Twin: src/smoothing/wendland.rs
fn shape(q: real) -> real {
    let outer = max(1.0 - 0.5 * q, 0.0);
    let square = outer * outer;
    return square * square * (2.0 * q + 1.0);
}
fn slope(q: real) -> real {
    let outer = max(1.0 - 0.5 * q, 0.0);
    return -5.0 * q * outer * outer * outer;
}
