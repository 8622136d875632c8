// phi = (1 - q)^2, -phi' and phi''. Twin: src/contact/quadratic.rs
#import real

fn potential_quadratic(q: real, exponent: u32) -> vec3<real> {
    let left = 1.0 - q;
    return vec3<real>(left * left, 2.0 * left, 2.0);
}
