// The velocity that moves a particle: a prescribed one is never smoothed. The pass declares `velocity`, for XSPH only where
// a scene has constraints. Twin: moving_velocity in src/pass/drift.rs
#import tensor
#if xsph
#import constraint if constraints

@group(0) @binding(_) var<storage, read> smoothed_velocity: array<Vec>;

fn moving_velocity(a: u32) -> Vec {
#if constraints
    if constraint[a] != 0u {
        return velocity[a];
    }
#endif
    return smoothed_velocity[a];
}
#else
fn moving_velocity(a: u32) -> Vec {
    return velocity[a];
}
#endif
