// Numbers of the formulation in which the bodies of a run may differ, laid out as in src/rows.rs; a test compares the
// offsets.
#import params
#import body_index

struct BodyOptions {
    alpha: real,
    beta: real,
    artificial_epsilon: real,
    hourglass: real,
}

#if body_options
// A row for each body.
@group(0) @binding(_) var<storage, read> body_options: array<BodyOptions>;

// Those of a particle's body. Twin: State::alpha and its neighbours in src/state.rs
fn options_of(a: u32) -> BodyOptions {
    return body_options[body_index(a)];
}
#else
// Those of all bodies.
fn options_of(a: u32) -> BodyOptions {
    return BodyOptions(params.alpha, params.beta, params.artificial_epsilon, params.hourglass);
}
#endif
