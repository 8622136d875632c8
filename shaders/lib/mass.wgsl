// Reference volume times reference density: constant. The pass declares `reference_volume`.
// Twin: State::mass in src/state.rs
#import body

fn mass(a: u32) -> real {
    return reference_volume[a] * body_of(a).density;
}
