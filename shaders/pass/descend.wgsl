// One step toward equilibrium: u += back v, then v = keep v + push a, then u += forward v, with a the out-of-balance
// acceleration. Twin: src/pass/descend.rs
#import unbalanced
#import compensated if compensated

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> balance: Balance;
@group(0) @binding(_) var<storage, read> acceleration: array<Vec>;
@group(0) @binding(_) var<storage, read_write> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity: array<Vec>;
#if compensated
@group(0) @binding(_) var<storage, read_write> displacement_carry: array<Vec>;
#endif

fn of_particle(a: u32) {
    let before = velocity[a];
    let after = before * balance.keep + unbalanced(a) * balance.push;
    let increment = before * balance.back + after * balance.forward;
    velocity[a] = after;
#if compensated
    let result = compensated_add(displacement[a], displacement_carry[a], increment);
    displacement[a] = result.sum;
    displacement_carry[a] = result.carry;
#else
    displacement[a] += increment;
#endif
}
