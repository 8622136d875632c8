// The stress of a pair, sigma_a/rho_a^2 + sigma_b/rho_b^2. Twin: specific_stress in src/pass/force.rs
#import pair

@group(0) @binding(_) var<storage, read> specific_stress: array<Sym>;

// sigma_a/rho_a^2
fn stress_of(a: u32) -> Sym {
    return specific_stress[a];
}

fn pair_stress(own: Sym, pair: Pair) -> Mat {
#if symmetry
    if pair.image != 0u {
        return mat_of_sym(own) + mirror_tensor(pair.image, mat_of_sym(specific_stress[pair.b]));
    }
#endif
    return mat_of_sym(sym_add(own, specific_stress[pair.b]));
}
