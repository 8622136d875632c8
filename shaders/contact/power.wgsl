// phi = (1 - q)^2.5, -phi' and phi''. Twin: src/contact/power.rs
#import real

fn potential_power(q: real, exponent: u32) -> vec3<real> {
    let left = 1.0 - q;
    let root = sqrt(left);
    let force = left * root;
    return vec3<real>(left * force, 2.5 * force, 3.75 * root);
}
