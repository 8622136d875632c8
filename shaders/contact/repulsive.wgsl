// Strand's repulsive force: phi = f^(n+1), f = W(r)/W(h) of the cubic spline, h half of the range, and -phi'.
// Twin: src/contact/repulsive.rs
#import real

fn potential_repulsive(q: real, exponent: u32) -> vec2<real> {
    let outer = max(2.0 - 2.0 * q, 0.0);
    let inner = max(1.0 - 2.0 * q, 0.0);
    let f = 4.0 * (0.25 * outer * outer * outer - inner * inner * inner);
    var power: real = 1.0;
    for (var k = 0u; k < exponent; k++) {
        power *= f;
    }
    let slope = -8.0 * real(exponent + 1u) * (3.0 * inner * inner - 0.75 * outer * outer);
    return vec2<real>(power * f, power * slope);
}
