// K_a^-1, K_a = sum V_b (X_b - X_a) (x) grad_a W_ab (Bonet & Lok 1999). Twin: src/pass/correct_reference.rs
#import bond
#import inverse

@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read_write> reference_correction: array<Sym>;

fn of_particle(a: u32, row: u32) {
    let h = smoothing_length(a);
    let index = body_index(a);
    let center = reference_position[a];
    let count = neighbor_count[a];
    var moment = Mat();
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(index, center, h, neighbors[k * params.chunk + row]);
        moment -= outer(bond.x, bond.x * (bond.gradient * reference_volume[bond.b]));
    }
    reference_correction[a] = sym_part(inverse_or(moment, mat_identity()));
}
