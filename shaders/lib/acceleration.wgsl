// What acts on a particle, and what is prescribed. The pass declares `acceleration`.
// Twins: acceleration, prescribe in src/pass/kick.rs
#import course
#import constraint if constraints

// Acceleration by neighbours, by the body force and by a prescribed force.
fn acceleration_at(a: u32, time: real) -> Vec {
    var sum = acceleration[a];
#if body_force
    sum += vec_of(params.body_force_x, params.body_force_y, params.body_force_z);
#endif
#if constraints
    if constraint[a] != 0u {
        let condition = constraints[constraint[a] - 1u];
        let vector = vec_of(condition.x, condition.y, condition.z) * course_factor(condition, time);
        sum += select(vector, Vec(0.0), mask_of(condition.prescribed));
    }
#endif
    return sum;
}

// Replaces the components of a velocity that a boundary condition prescribes.
fn prescribe(a: u32, v: Vec, time: real) -> Vec {
#if constraints
    if constraint[a] != 0u {
        let condition = constraints[constraint[a] - 1u];
        let vector = vec_of(condition.x, condition.y, condition.z) * course_factor(condition, time);
        return select(v, vector, mask_of(condition.prescribed));
    }
#endif
    return v;
}
