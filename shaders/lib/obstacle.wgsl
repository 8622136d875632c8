// Rigid bodies of exact shape. Twin: src/obstacle.rs
#import tensor

// Twin: Obstacle in src/rows.rs; a test compares the offsets.
struct Obstacle {
    kind: u32,
    padding: u32,
    point_x: real,
    point_y: real,
    point_z: real,
    axis_x: real,
    axis_y: real,
    axis_z: real,
    turn_x: real,
    turn_y: real,
    turn_z: real,
    radius: real,
    cosine: real,
    sine: real,
}

// Signed distance from the surface, negative inside, and the outward normal.
struct Nearest {
    gap: real,
    normal: Vec,
}

// `x` is relative to the obstacle's point.
fn obstacle_distance(obstacle: Obstacle, x: Vec) -> Nearest {
    let axis = vec_of(obstacle.axis_x, obstacle.axis_y, obstacle.axis_z);
    let turn = vec_of(obstacle.turn_x, obstacle.turn_y, obstacle.turn_z);
    switch obstacle.kind {
        case 0u: { return Nearest(inner(x, axis), axis); }
        case 1u: { return ball_distance(x, axis, obstacle.radius); }
        case 2u: { return ball_distance(x - turn * inner(x, turn), axis, obstacle.radius); }
        case 3u: { return cone_distance(obstacle, x, axis); }
        default: { return pyramid_distance(obstacle, x, axis, turn); }
    }
}

// |x - R a| - R, without the digits of R.
fn ball_distance(x: Vec, axis: Vec, radius: real) -> Nearest {
    let from_center = x - axis * radius;
    let away = sqrt(inner(from_center, from_center));
    let gap = inner(x, x - axis * (radius + radius)) / (away + radius);
    return Nearest(gap, direction_or(from_center, away, axis));
}

// A vector over its length, or against the axis where it has none.
fn direction_or(v: Vec, length: real, axis: Vec) -> Vec {
    if length > 0.0 {
        return v * (1.0 / length);
    }
    return -axis;
}

fn cone_distance(obstacle: Obstacle, x: Vec, axis: Vec) -> Nearest {
    let height = inner(x, axis);
    let across = x - axis * height;
    let radius = sqrt(inner(across, across));
    let gap = radius * obstacle.cosine - height * obstacle.sine;
    if radius * obstacle.sine + height * obstacle.cosine < 0.0 {
        // Nothing is nearer than the apex.
        let away = sqrt(inner(x, x));
        return Nearest(away, direction_or(x, away, axis));
    }
    if radius > 0.0 {
        return Nearest(gap, across * (obstacle.cosine / radius) - axis * obstacle.sine);
    }
    return Nearest(gap, -axis);
}

fn pyramid_distance(obstacle: Obstacle, x: Vec, axis: Vec, turn: Vec) -> Nearest {
    let third = vec_of(
        obstacle.axis_y * obstacle.turn_z - obstacle.axis_z * obstacle.turn_y,
        obstacle.axis_z * obstacle.turn_x - obstacle.axis_x * obstacle.turn_z,
        obstacle.axis_x * obstacle.turn_y - obstacle.axis_y * obstacle.turn_x,
    );
    let second = turn * -0.5 + third * 0.8660254037844386;
    let last = turn * -0.5 - third * 0.8660254037844386;
    // Directions across the axis in which the faces look; their sum is zero, so the furthest along is never negative.
    var face = turn;
    var reach = inner(x, turn);
    if inner(x, second) > reach {
        face = second;
        reach = inner(x, second);
    }
    if inner(x, last) > reach {
        face = last;
        reach = inner(x, last);
    }
    let gap = reach * obstacle.cosine - inner(x, axis) * obstacle.sine;
    if reach > 0.0 {
        return Nearest(gap, face * obstacle.cosine - axis * obstacle.sine);
    }
    return Nearest(gap, -axis);
}
