// Acceleration of what is free, by the bonds and by the loads of the present load step; zero where it is held. The
// pass declares `clock` and `acceleration`. Twin: unbalanced in src/pass/bound_residual.rs
#import course
#import constraint if constraints

fn unbalanced(a: u32) -> Vec {
    var sum = acceleration[a];
    let time = clock.start + clock.duration;
    let part = time * params.load_rate;
#if body_force
    sum += vec_of(params.body_force_x, params.body_force_y, params.body_force_z) * part;
#endif
#if constraints
    if constraint[a] != 0u {
        let condition = constraints[constraint[a] - 1u];
        var factor = part;
        if condition.course_count != 0u {
            factor = course_factor(condition, time);
        }
        let loaded = sum + vec_of(condition.x, condition.y, condition.z) * factor;
        return select(loaded, Vec(0.0), mask_of(condition.prescribed));
    }
#endif
    return sum;
}
