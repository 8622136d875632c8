// A material of a pressure and a strength at finite strain. Twin: src/material/mod.rs
#import inelastic
#import pressures
#import finite_return if plastic

fn first_piola_of_roles(body: Body, h: Mat, memory: Sym) -> Mat {
    return first_piola_inelastic(body, h, memory, kirchhoff(body, volume_change(h)));
}

#if plastic
fn relax_of_roles(body: Body, h: Mat, memory: Memory, step: real) -> Memory {
    return relax_to_yield(body, h, memory, step);
}

fn dissipated_of_roles(body: Body, old_h: Mat, old_memory: Sym, h: Mat, memory: Sym) -> real {
    return dissipated_inelastic(body, old_h, old_memory, h, memory);
}
#endif
