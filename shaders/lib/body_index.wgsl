// Which body a particle belongs to. Twin: State::body_index in src/state.rs

#if many_bodies
@group(0) @binding(_) var<storage, read> body: array<u32>;
#endif

fn body_index(a: u32) -> u32 {
#if many_bodies
    return body[a];
#else
    return 0u;
#endif
}
