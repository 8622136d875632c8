// Boundary conditions and their courses in time. Twin: State::course_factor in src/state.rs
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
