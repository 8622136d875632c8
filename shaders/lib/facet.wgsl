// Contact of surfaces through their facets. The pass declares the columns of facets that it reads.
// Twin: src/facet.rs
#import params

// How two facets face each other: x_e - x_f, the weight, and its derivatives by x (times x) and by n_e.n_f. All but the
// first are zero out of range, and where the two look the same way.
struct Facing {
    x: Vec,
    weight: real,
    by_distance: real,
    by_turn: real,
}

// A facet as the loop over others sees it, loaded once.
struct Seat {
    reference: Vec,
    displacement: Vec,
    normal: Vec,
}

fn seat(e: u32) -> Seat {
    return Seat(facet_reference_position[e], facet_displacement[e], facet_normal[e]);
}

fn facet_separation(own: Seat, f: u32) -> Vec {
    return (own.reference - facet_reference_position[f]) + (own.displacement - facet_displacement[f]);
}

fn facing(own: Seat, f: u32, range: real) -> Facing {
    let x = facet_separation(own, f);
    let left = max(1.0 - inner(x, x) / (range * range), 0.0);
    let turn = min(inner(own.normal, facet_normal[f]), 0.0);
    let square = left * left;
    let cube = left * left * left;
    let toward = turn * turn;
    return Facing(x, cube * toward, -6.0 * square * toward / (range * range), 2.0 * cube * turn);
}

// 3 t^2 - 2 t^3 up to t = 1, and its derivative by t.
fn fade(t: real) -> vec2<real> {
    if t >= 1.0 {
        return vec2<real>(1.0, 0.0);
    }
    return vec2<real>(t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t));
}
