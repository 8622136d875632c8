// phi = (1 - q)^2.5 and -phi'. Twin: src/contact/power.rs
#import real

fn potential_power(q: real, exponent: u32) -> vec2<real> {
    let left = 1.0 - q;
    let force = left * sqrt(left);
    return vec2<real>(left * force, 2.5 * force);
}
