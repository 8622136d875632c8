// Present volume of a particle. The pass declares `reference_volume` and `volumetric_strain`.
// Twin: State::volume in src/state.rs
#import real

fn volume(a: u32) -> real {
    return reference_volume[a] * (1.0 + volumetric_strain[a]);
}
