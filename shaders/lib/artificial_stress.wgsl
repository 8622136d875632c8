// The artificial stress, (R_a + R_b) f^n grad_a W_ab for each mass of the neighbour. Twin: artificial_stress in
// src/pass/force.rs
#import pair

#if scalar_form
@group(0) @binding(_) var<storage, read> artificial_pressure: array<real>;

// R of a particle.
fn repulsion_of(a: u32) -> real {
    return artificial_pressure[a];
}

// (R_a + R_b) grad_a W_ab
fn repulsion(own: real, pair: Pair, gradient: Vec) -> Vec {
    return gradient * (own + artificial_pressure[pair.b]);
}
#else
@group(0) @binding(_) var<storage, read> artificial_stress: array<Sym>;

// R of a particle.
fn repulsion_of(a: u32) -> Sym {
    return artificial_stress[a];
}

// (R_a + R_b) grad_a W_ab
fn repulsion(own: Sym, pair: Pair, gradient: Vec) -> Vec {
#if symmetry
    if pair.image != 0u {
        let image = mirror_tensor(pair.image, mat_of_sym(artificial_stress[pair.b]));
        return mat_vec(mat_of_sym(own) + image, gradient);
    }
#endif
    return sym_vec(sym_add(own, artificial_stress[pair.b]), gradient);
}
#endif

// f^n: the kernel over its value at the particles' first distance, so that only close pairs repel. A whole power
// without the cost of a general one.
fn nearness(pair: Pair) -> real {
    let base = weight(pair.distance, pair.h) / params.artificial_weight;
    var product: real = 1.0;
    for (var k = 0u; k < params.artificial_exponent; k++) {
        product *= base;
    }
    return product;
}
