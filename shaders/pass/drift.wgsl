// u += part step v, or the smoothed velocity for XSPH. Twin: src/pass/drift.rs
#import params
#import moving_velocity
#import compensated if compensated

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read_write> displacement: array<Vec>;
#if compensated
@group(0) @binding(_) var<storage, read_write> displacement_carry: array<Vec>;
#endif
#if xsph
#if constraints
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
#endif
#else
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
#endif

// Part of the step that the drift takes.
override stage_part: real;

fn of_particle(a: u32) {
    let increment = moving_velocity(a) * (stage_part * clock.step);
#if compensated
    let result = compensated_add(displacement[a], displacement_carry[a], increment);
    displacement[a] = result.sum;
    displacement_carry[a] = result.carry;
#else
    displacement[a] += increment;
#endif
}
