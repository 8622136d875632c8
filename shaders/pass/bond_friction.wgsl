// Adds Monaghan's viscosity between the ends of the bonds of the reference configuration, the kernel's slope at the
// distance there and the force along the present separation. Twin: src/pass/bond_friction.rs
#import displacement_difference
#import body_options

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;
#if dissipated_power
@group(0) @binding(_) var<storage, read_write> dissipated_power: array<real>;
#endif

fn of_particle(a: u32, row: u32) {
    let own_body = body_of(a);
    let options = options_of(a);
    let index = body_index(a);
    let center = reference_position[a];
    let displacement_a = displacement[a];
    let velocity_a = velocity[a];
    let count = neighbor_count[a];
    var sum = Vec();
    var power: real = 0.0;
    let h = smoothing_length(a);
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(index, center, h, neighbors[k * params.chunk + row]);
        // x_a - x_b
        let x = bond.x - displacement_difference(displacement_a, bond);
        let v_ba = velocity_difference(velocity_a, bond);
#if tied
        let friction = friction_of_ends(own_body, options, index, h, bond, x, v_ba);
#else
        let friction = friction_of(options, own_body.sound_speed, h, bond, x, v_ba);
#endif
        sum += friction;
        power += 0.5 * inner(v_ba, friction);
    }
    acceleration[a] += sum;
#if dissipated_power
    dissipated_power[a] = power;
#endif
}

#if tied
// The same for a bond that may join two bodies: with the means of its ends, so that both feel the same Pi and momentum is kept,
// with m_b over the mean density in the place of V_b, and without the weight of its end a.
fn friction_of_ends(own: Body, of_a: BodyOptions, body_a: u32, h: real, bond: Bond, x: Vec, v_ba: Vec) -> Vec {
    let other = body_of(bond.b);
    var options = of_a;
#if body_options
    let of_b = options_of(bond.b);
    options.alpha = 0.5 * (options.alpha + of_b.alpha);
    options.beta = 0.5 * (options.beta + of_b.beta);
#endif
    let sound_speed = 0.5 * (own.sound_speed + other.sound_speed);
    let share = other.density / (0.5 * (own.density + other.density)) / pair_coupling(body_a, bond.b);
    return friction_of(options, sound_speed, h, bond, x, v_ba) * share;
}
#endif

fn friction_of(options: BodyOptions, sound_speed: real, h: real, bond: Bond, x: Vec, v_ba: Vec) -> Vec {
    let square = inner(x, x);
    let mu = min(-h * inner(v_ba, x) / (square + params.softening * h * h), 0.0);
    let pi = (options.beta * mu - options.alpha * sound_speed) * mu;
    let weight = bond.gradient * reference_volume[bond.b];
    let reference = sqrt(inner(bond.x, bond.x));
    // The slope times V_b; within a body m_b over rho_0 is V_b.
    return x * (-pi * weight * reference / max(sqrt(square), 1e-6 * h));
}

// v_b - v_a, the neighbour's velocity mirrored if it is an image.
fn velocity_difference(velocity_a: Vec, bond: Bond) -> Vec {
    var velocity_b = velocity[bond.b];
#if symmetry
    if bond.image != 0u {
        velocity_b = mirror_vector(bond.image, velocity_b);
    }
#endif
    return velocity_b - velocity_a;
}
