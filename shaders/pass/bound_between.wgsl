// Ends a step of several groups, after each has bounded its own: all take the shortest of the steps, and stop together; and
// finds whether the list of contacts between groups still holds. Twin: src/pass/bound_between.rs
#import invocation
#import params
#import largest

@group(0) @binding(_) var<storage, read_write> clock: Clock;
// One for each group, of the same step.
@group(0) @binding(_) var<storage, read_write> group_clocks: array<Clock>;
@group(0) @binding(_) var<storage, read_write> block_bound: array<vec4<real>>;
#if listed_again
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> listed_displacement: array<Vec>;
#endif
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
#if potentials
@group(0) @binding(_) var<storage, read> contact_rate: array<real>;
#endif

@compute @workgroup_size(256)
fn blocks(invocation: Invocation) {
    let block = block_of(invocation);
    let a = block * REDUCTION_BLOCK + invocation.local;
    var own = vec4<real>();
    if a < params.count && clock.running != 0u {
        own = motion_of(a);
    }
    let motion = largest(invocation.local, own);
    if invocation.local == 0u && a < params.count && clock.running != 0u {
        block_bound[block] = motion;
    }
}

// Squared rate of the contacts between groups, squared displacement since the list was built, and squared speed, where they stand in the bound of a group.
fn motion_of(a: u32) -> vec4<real> {
#if listed_again
    let shift = displacement[a] - listed_displacement[a];
    let moved = inner(shift, shift);
#else
    let moved: real = 0.0;
#endif
#if potentials
    let rate = contact_rate[a];
#else
    let rate: real = 0.0;
#endif
    return vec4<real>(rate, moved, inner(velocity[a], velocity[a]), 0.0);
}

@compute @workgroup_size(256)
fn advance(invocation: Invocation) {
    let count = (params.count + REDUCTION_BLOCK - 1u) / REDUCTION_BLOCK;
    var own = vec4<real>();
    for (var block = invocation.local; block < count; block += REDUCTION_BLOCK) {
        own = max(own, block_bound[block]);
    }
    let motion = largest(invocation.local, own);
    if invocation.local == 0u && clock.running != 0u {
        agree(motion);
    }
}

// A group that has less left than a rounding error of its step stops; then all do.
fn agree(motion: vec4<real>) {
    var agreed = group_clocks[0];
    let groups = arrayLength(&group_clocks);
    for (var k = 1u; k < groups; k += 1u) {
        let other = group_clocks[k];
        agreed.step = min(agreed.step, other.step);
        agreed.running = min(agreed.running, other.running);
        agreed.fault = select(agreed.fault, other.fault, agreed.fault == 0u);
        agreed.lists_built = max(agreed.lists_built, other.lists_built);
        agreed.changes = max(agreed.changes, other.changes);
    }
    if clock.fault != 0u {
        agreed.fault = clock.fault;
        agreed.running = 0u;
    }
    if motion.x > 0.0 && params.fixed_step == 0.0 {
        agreed.step = min(agreed.step, params.cfl / sqrt(motion.x));
    }
#if listed_again
    let ahead = sqrt(motion.y) + sqrt(motion.z) * agreed.step;
    agreed.rebuild = u32(ahead > params.slack);
#else
    agreed.rebuild = 0u;
#endif
    clock = agreed;
    for (var k = 0u; k < groups; k += 1u) {
        group_clocks[k].step = agreed.step;
        group_clocks[k].held = agreed.step;
        group_clocks[k].running = agreed.running;
        group_clocks[k].fault = agreed.fault;
    }
}
