// What the law of a particle remembers, taken to the end of the step. The pass declares `clock` and
// `displacement_gradient`, which still holds the gradient at the step's start. Twin: relax in src/pass/deform.rs
#import laws
#import temperature

@group(0) @binding(_) var<storage, read_write> inelastic_strain: array<Sym>;
#if dissipated_energy
@group(0) @binding(_) var<storage, read_write> dissipated_energy: array<real>;
#endif

// Takes the memory to the new H. Before the first step the clock's is 0.
fn relax_to(a: u32, gradient: Mat) {
    let own = body_of(a);
    let old = remembered(a);
    let memory = relax(own, gradient, old, clock.step);
    inelastic_strain[a] = memory.strain;
#if plastic
    equivalent_plastic_strain[a] = memory.plastic;
#endif
    set_temperature(a, memory.temperature);
#if dissipated_energy
    dissipated_energy[a] += dissipated(own, displacement_gradient[a], old.strain, gradient, memory.strain) * (1.0 / own.density);
#endif
}

// What the law remembers from before the step.
#if plastic
@group(0) @binding(_) var<storage, read_write> equivalent_plastic_strain: array<real>;
#if quasi_static
@group(0) @binding(_) var<storage, read> equilibrium_inelastic_strain: array<Sym>;
@group(0) @binding(_) var<storage, read> equilibrium_plastic_strain: array<real>;

// In a descent to equilibrium, which is no motion in time, every step begins at the last equilibrium.
fn remembered(a: u32) -> Memory {
    return Memory(equilibrium_inelastic_strain[a], equilibrium_plastic_strain[a], temperature_of(a));
}
#else
fn remembered(a: u32) -> Memory {
    return Memory(inelastic_strain[a], equivalent_plastic_strain[a], temperature_of(a));
}
#endif
#else
fn remembered(a: u32) -> Memory {
    return Memory(inelastic_strain[a], 0.0, temperature_of(a));
}
#endif
