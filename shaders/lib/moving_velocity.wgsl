// The velocity that moves a particle: a prescribed one is never smoothed. The pass declares `velocity`, for
// XSPH `smoothed_velocity`, and with it `constraint` where a scene has constraints.
// Twin: moving_velocity in src/pass/drift.rs
#import tensor

fn moving_velocity(a: u32) -> Vec {
#if xsph
#if constraints
    if constraint[a] != 0u {
        return velocity[a];
    }
#endif
    return smoothed_velocity[a];
#else
    return velocity[a];
#endif
}
