// Strand's repulsive force: phi = f^(n+1), f = W(r)/W(h) of the cubic spline, h half of the range, -phi' and phi''.
// Twin: src/contact/repulsive.rs
#import real

fn potential_repulsive(q: real, exponent: u32) -> vec3<real> {
    let outer = max(2.0 - 2.0 * q, 0.0);
    let inner = max(1.0 - 2.0 * q, 0.0);
    let f = 4.0 * (0.25 * outer * outer * outer - inner * inner * inner);
    var lower: real = 1.0;
    for (var k = 1u; k < exponent; k++) {
        lower *= f;
    }
    let n = real(exponent);
    let power = lower * f;
    let slope = -8.0 * (3.0 * inner * inner - 0.75 * outer * outer);
    let bend = 24.0 * outer - 96.0 * inner;
    return vec3<real>(power * f, (n + 1.0) * power * slope, (n + 1.0) * lower * (n * slope * slope + f * bend));
}
