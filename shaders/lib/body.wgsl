// Numbers of a particle's body. Twin: State::body in src/state.rs
#import params
#import body_index

@group(0) @binding(_) var<storage, read> bodies: array<Body>;

fn body_of(a: u32) -> Body {
    return bodies[body_index(a)];
}
