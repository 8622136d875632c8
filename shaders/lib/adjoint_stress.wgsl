// The stress of a pair that is adjoint to the corrected velocity gradient, sigma_a K_a^-1 + sigma_b K_b^-1.
// Twin: corrected_stress in src/pass/force.rs
#import pair

@group(0) @binding(_) var<storage, read> corrected_stress: array<Mat>;

// sigma_a K_a^-1
fn stress_of(a: u32) -> Mat {
    return corrected_stress[a];
}

fn pair_stress(own: Mat, pair: Pair) -> Mat {
    var other = corrected_stress[pair.b];
#if symmetry
    if pair.image != 0u {
        other = mirror_tensor(pair.image, other);
    }
#endif
    return own + other;
}
