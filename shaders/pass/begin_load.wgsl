// Begins a load step: what is held moves by the integral of its prescribed velocity over the load step, what is
// free goes on as far as between the last two equilibria, and all velocities are set to zero. What plastic bodies
// remember of the load step before is settled.
// Twin: src/pass/begin_load.rs
#import course_integral
#import constraint if constraints
#import compensated if compensated

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read_write> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> equilibrium_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity: array<Vec>;
#if compensated
@group(0) @binding(_) var<storage, read_write> displacement_carry: array<Vec>;
#endif
#if plastic
@group(0) @binding(_) var<storage, read> inelastic_strain: array<Sym>;
@group(0) @binding(_) var<storage, read> equivalent_plastic_strain: array<real>;
@group(0) @binding(_) var<storage, read_write> equilibrium_inelastic_strain: array<Sym>;
@group(0) @binding(_) var<storage, read_write> equilibrium_plastic_strain: array<real>;
#endif

fn of_particle(a: u32) {
    let before = displacement[a];
    let increment = increment_of(a, before - equilibrium_displacement[a]);
    equilibrium_displacement[a] = before;
#if compensated
    let result = compensated_add(before, displacement_carry[a], increment);
    displacement[a] = result.sum;
    displacement_carry[a] = result.carry;
#else
    displacement[a] = before + increment;
#endif
    velocity[a] = Vec();
#if plastic
    equilibrium_inelastic_strain[a] = inelastic_strain[a];
    equilibrium_plastic_strain[a] = equivalent_plastic_strain[a];
#endif
}

// By how much a particle moves when a load step begins: a free one by its increment over the last load step, a held one by
// the integral of its prescribed velocity.
fn increment_of(a: u32, last: Vec) -> Vec {
#if constraints
    if constraint[a] != 0u {
        let condition = constraints[constraint[a] - 1u];
        let time = course_integral(condition, clock.start, clock.start + clock.duration);
        let vector = vec_of(condition.x, condition.y, condition.z) * time;
        return select(last, vector, mask_of(condition.prescribed));
    }
#endif
    return last;
}
