// Boundary conditions and their courses in time. The pass declares `acceleration`, and `constraint` where a
// scene has constraints. Twins: State::course_factor in src/state.rs; acceleration, prescribe in src/pass/kick.rs
#import params

#if constraints
@group(0) @binding(_) var<storage, read> constraints: array<Constraint>;
@group(0) @binding(_) var<storage, read> course: array<vec2<real>>;

// Factor of a boundary condition's course at an absolute time: points of time and factor, joined by lines.
fn course_factor(condition: Constraint, time: real) -> real {
    if condition.course_count == 0u {
        return 1.0;
    }
    var before = course[condition.course_first];
    if time <= before.x {
        return before.y;
    }
    for (var k = 1u; k < condition.course_count; k++) {
        let point = course[condition.course_first + k];
        if time < point.x {
            return before.y + (point.y - before.y) * (time - before.x) / (point.x - before.x);
        }
        before = point;
    }
    return before.y;
}
#endif

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
