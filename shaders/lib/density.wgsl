// Present density of a particle. The pass declares `volumetric_strain`.
// Twin: State::density in src/state.rs
#import body

fn density(a: u32) -> real {
    return body_of(a).density / (1.0 + volumetric_strain[a]);
}
