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
    // Bonds join particles of one body.
    let options = options_of(a);
    let center = reference_position[a];
    let displacement_a = displacement[a];
    let velocity_a = velocity[a];
    let count = neighbor_count[a];
    var sum = Vec();
    var power: real = 0.0;
    let h = smoothing_length(a);
    for (var k = 0u; k < count; k++) {
        let bond = bond_of(center, h, neighbors[k * params.chunk + row]);
        // x_a - x_b
        let x = bond.x - displacement_difference(displacement_a, bond);
        let v_ba = velocity_difference(velocity_a, bond);
        let friction = friction_of(own_body, options, h, bond, x, v_ba);
        sum += friction;
        power += 0.5 * inner(v_ba, friction);
    }
    acceleration[a] += sum;
#if dissipated_power
    dissipated_power[a] = power;
#endif
}

fn friction_of(own_body: Body, options: BodyOptions, h: real, bond: Bond, x: Vec, v_ba: Vec) -> Vec {
    let square = inner(x, x);
    let mu = min(-h * inner(v_ba, x) / (square + params.softening * h * h), 0.0);
    let pi = (options.beta * mu - options.alpha * own_body.sound_speed) * mu;
    let weight = bond.gradient * reference_volume[bond.b];
    let reference = sqrt(inner(bond.x, bond.x));
    // The slope times V_b; m_b over rho_0 is V_b.
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
