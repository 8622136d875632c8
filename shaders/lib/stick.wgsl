// Coulomb friction with an elastic slip. Twin: stick in src/facet.rs
#import tensor

struct Stick {
    slip: Vec,
    heat: real,
}

fn stick(before: Vec, slip: Vec, stiffness: real, limit: real) -> Stick {
    let length = sqrt(inner(slip, slip));
    let most = limit / stiffness;
    if length <= most {
        return Stick(slip, 0.0);
    }
    let left = slip * (most / length);
    return Stick(left, 0.5 * stiffness * inner(before + left, slip - left));
}
