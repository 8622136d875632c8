// The tables that every run has, laid out as in src/rows.rs; a test compares the offsets.
#import tensor

struct Params {
    // Mirror planes: normal and distance from the origin along it.
    planes: array<vec4<real>, 3>,
    count: u32,
    first: u32,
    chunk: u32,
    list_capacity: u32,
    cells_x: u32,
    cells_y: u32,
    cells_z: u32,
    cell_total: u32,
    plane_count: u32,
    body_count: u32,
    artificial_exponent: u32,
    contact_capacity: u32,
    facet_count: u32,
    facet_capacity: u32,
    obstacle_count: u32,
    facet_alike: u32,
    surface_count: u32,
    corner_count: u32,
    zero: u32,
    origin_x: real,
    origin_y: real,
    origin_z: real,
    cell_x: real,
    cell_y: real,
    cell_z: real,
    period_x: real,
    period_y: real,
    period_z: real,
    body_force_x: real,
    body_force_y: real,
    body_force_z: real,
    normalisation: real,
    reach: real,
    contact_reach: real,
    facet_reach: real,
    contact_rate: real,
    contact_apart: real,
    slack: real,
    hourglass: real,
    alpha: real,
    beta: real,
    softening: real,
    smoothing_weight: real,
    artificial_epsilon: real,
    artificial_weight: real,
    cfl: real,
    fixed_step: real,
    rest_step: real,
    interval: real,
    stable: real,
    residual: real,
    load_rate: real,
}

struct Body {
    whole: u32,
    pressure: u32,
    strength: u32,
    heat: u32,
    density: real,
    bulk_modulus: real,
    shear_modulus: real,
    youngs_modulus: real,
    yield_stress: real,
    sound_speed: real,
    smoothing_length: real,
    frequency: real,
    numbers: array<real, 32>,
}

struct ContactPair {
    law: u32,
    exponent: u32,
    strength: real,
    range: real,
    threshold: real,
    friction: real,
}

struct FacetPair {
    stiffness: real,
    range: real,
    full: real,
    friction: real,
}

struct Mover {
    condition: u32,
    inverse_mass: real,
}

struct Constraint {
    prescribed: u32,
    course_first: u32,
    course_count: u32,
    padding: u32,
    x: real,
    y: real,
    z: real,
    unused: real,
}

struct Clock {
    start: real,
    elapsed: real,
    elapsed_carry: real,
    step: real,
    duration: real,
    steps_left: u32,
    steps_done: u32,
    // 0 once the segment is over. The plainer name `active` is a reserved word of WGSL.
    running: u32,
    rebuild: u32,
    lists_built: u32,
    changes: u32,
    held: real,
    arrived: u32,
    fault: u32,
    residual: real,
}

// A step of the descent to equilibrium does u += back v, then v = keep v + push a, then u += forward v.
struct Balance {
    back: real,
    keep: real,
    push: real,
    forward: real,
    mixing: real,
    longest: real,
    downhill: u32,
    padding: u32,
}

// Laws of contact that are no potentials. Twin: src/contact/mod.rs
const COLOUR_FIELD: u32 = 100u;
const ZONES: u32 = 101u;

const LIST_FULL: u32 = 1u;
const NOT_FINITE: u32 = 2u;
const INVERTED: u32 = 3u;
const NO_EQUILIBRIUM: u32 = 4u;

// Low bits of a neighbour-list entry: the neighbour; the three bits above: the planes it is mirrored in.
const NEIGHBOR_BITS: u32 = 29u;
const NEIGHBOR_MASK: u32 = 0x1fffffffu;

@group(0) @binding(_) var<uniform> params: Params;
