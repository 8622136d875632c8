// The velocity filter: what XSPH became in Fuller's code. Twin: src/pass/filter_velocity.rs
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> smoothed_velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity: array<Vec>;
#if constraints
@group(0) @binding(_) var<storage, read> constraint: array<u32>;
#endif

fn of_particle(a: u32) {
#if constraints
    if constraint[a] != 0u {
        return;
    }
#endif
    velocity[a] = smoothed_velocity[a];
}
