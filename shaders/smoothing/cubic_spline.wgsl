// Cubic B-spline, Fuller (2.5), (2.10). Twin: src/smoothing/cubic_spline.rs
fn shape(q: real) -> real {
    let outer = max(2.0 - q, 0.0);
    let inner = max(1.0 - q, 0.0);
    return 0.25 * outer * outer * outer - inner * inner * inner;
}
fn slope(q: real) -> real {
    let outer = max(2.0 - q, 0.0);
    let inner = max(1.0 - q, 0.0);
    return 3.0 * inner * inner - 0.75 * outer * outer;
}
