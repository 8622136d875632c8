// The velocity filter: what XSPH became in Fuller's code. Twin: src/pass/filter_velocity.rs
#import invocation
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> smoothed_velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity: array<Vec>;
#if constraints
@group(0) @binding(_) var<storage, read> constraint: array<u32>;
#endif

@compute @workgroup_size(64)
fn main(invocation: Invocation) {
    let a = index_of(invocation);
    if a >= params.count || clock.running == 0u {
        return;
    }
#if constraints
    if constraint[a] != 0u {
        return;
    }
#endif
    velocity[a] = smoothed_velocity[a];
}
