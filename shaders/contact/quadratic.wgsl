// phi = (1 - q)^2 and -phi'. Twin: src/contact/quadratic.rs
#import real

fn potential_quadratic(q: real, exponent: u32) -> vec2<real> {
    let left = 1.0 - q;
    return vec2<real>(left * left, 2.0 * left);
}
