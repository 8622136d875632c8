// Weight of a pair: 1 unless a scene weakens the kernel sums between two bodies.
// Twin: pair_coupling in src/pair.rs
#import params
#import body_index

#if coupling
@group(0) @binding(_) var<storage, read> coupling: array<real>;
#endif

// The first particle is given by its body, which a loop over neighbours looks up once.
fn pair_coupling(body_a: u32, b: u32) -> real {
#if coupling
    return coupling[body_a * params.body_count + body_index(b)];
#else
    return 1.0;
#endif
}
