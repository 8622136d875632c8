// phi = -(1 - q)^2 ln q and -phi'. Twin: src/contact/barrier.rs
#import real

fn potential_barrier(q: real, exponent: u32) -> vec2<real> {
    let left = 1.0 - q;
    let logarithm = log(q);
    return vec2<real>(-left * left * logarithm, left * (left / q - 2.0 * logarithm));
}
