// The velocity filter: what XSPH became in Fuller's code. Twin: src/pass/filter_velocity.rs
#import params
#import constraint if constraints

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> smoothed_velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> velocity: array<Vec>;

fn of_particle(a: u32) {
#if constraints
    if constraint[a] != 0u {
        return;
    }
#endif
    velocity[a] = smoothed_velocity[a];
}
