// phi = -(1 - q)^2 ln q, -phi' and phi''. Twin: src/contact/barrier.rs
#import real

fn potential_barrier(q: real, exponent: u32) -> vec3<real> {
    let left = 1.0 - q;
    let logarithm = log(q);
    let part = left / q;
    return vec3<real>(-left * left * logarithm, left * (part - 2.0 * logarithm), part * (4.0 + part) - 2.0 * logarithm);
}
