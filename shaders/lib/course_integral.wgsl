// Integral of a boundary condition's course. Twin: State::course_integral in src/state.rs
#import course

#if constraints
// Integral of a boundary condition's course between two absolute times.
fn course_integral(condition: Constraint, start: real, end: real) -> real {
    if condition.course_count == 0u {
        return end - start;
    }
    var before = course[condition.course_first];
    let last = course[condition.course_first + condition.course_count - 1u];
    var sum = before.y * max(min(end, before.x) - start, 0.0) + last.y * max(end - max(start, last.x), 0.0);
    for (var k = 1u; k < condition.course_count; k++) {
        let point = course[condition.course_first + k];
        let low = max(start, before.x);
        let high = min(end, point.x);
        if high > low {
            let middle = 0.5 * (low + high);
            sum += (high - low) * (before.y + (point.y - before.y) * (middle - before.x) / (point.x - before.x));
        }
        before = point;
    }
    return sum;
}
#endif
