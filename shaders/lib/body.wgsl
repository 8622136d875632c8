// Numbers of a particle's body. Twin: State::body in src/state.rs
#import params
#import body_index

@group(0) @binding(_) var<storage, read> bodies: array<Body>;

fn body_of(a: u32) -> Body {
    return bodies[body_index(a)];
}

// h of a particle: a number of its body. Twin: State::smoothing_length in src/state.rs
fn smoothing_length(a: u32) -> real {
    return body_of(a).smoothing_length;
}
