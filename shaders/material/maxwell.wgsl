// Maxwell body of Simo & Miehe 1992, Shutov & Klyuchantsev 2019 (14) to (16). Memory: C_i - 1.
// Twin: src/material/maxwell.rs
#import inelastic
#import memory
#import volumetric_stress

fn first_piola_maxwell(body: Body, h: Mat, memory: Sym) -> Mat {
    return first_piola_inelastic(body, h, memory, volumetric_stress(body.bulk_modulus, volume_change(h)));
}

// The memory after a step that ends at H: the unimodular part of C_i + step mu/eta C', (16).
fn relax_maxwell(body: Body, h: Mat, memory: Memory, step: real) -> Memory {
    let relaxation = body.shear_modulus / maxwell_of(body).viscosity;
    return Memory(relaxed(h, memory.strain, step * relaxation), memory.plastic, memory.temperature);
}

fn dissipated_maxwell(body: Body, old_h: Mat, old_memory: Sym, h: Mat, memory: Sym) -> real {
    return dissipated_inelastic(body, old_h, old_memory, h, memory);
}
