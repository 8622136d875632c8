// Adds the acceleration by contacts that have an energy, and finds each particle's part of it. By a potential
// m_a a_a += sum strength/range (-phi'(r/range)) x_ab/r, half of the pairs' energy; by the colour field
// m_a a_a -= sum k V_a V_b (<c_a - c0> + <c_b - c0>) grad_a W_ab, (k/2) V_a <c_a - c0>^2. Twin: src/pass/contact_force.rs
#import separation
#import mass
#import body
#import contact_pair
#import potential if potentials
#import kernel if colour_field

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> contacts: array<u32>;
@group(0) @binding(_) var<storage, read> contact_count: array<u32>;
#if colour_field
@group(0) @binding(_) var<storage, read> colour_excess: array<real>;
#endif
#if potentials
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
@group(0) @binding(_) var<storage, read_write> contact_rate: array<real>;
#endif
@group(0) @binding(_) var<storage, read_write> contact_energy: array<real>;
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;

fn of_particle(a: u32) {
    let listed = contact_count[a];
    var energy: real = 0.0;
    var force = Vec();
    var stiffness: real = 0.0;
#if potentials
    var rate: real = 0.0;
    // After an output the next step may be as long as that of the unstressed body.
    let ahead = max(clock.step, params.cfl * smoothing_length(a) / body_of(a).sound_speed);
    // What the body's own forces add to the speed. Those on the other particle are taken to be alike.
    let gained = ahead * sqrt(inner(acceleration[a], acceleration[a]));
#endif
    for (var k = 0u; k < listed; k++) {
        let b = contacts[k * params.count + a];
        let pair = contact_pair(a, b);
        let x = separation(reference_position[a], displacement[a], b, displacement[b]);
        let distance = sqrt(inner(x, x));
#if potentials
        if pair.law < COLOUR_FIELD {
            // Particles that part may come back within a step: surfaces tremble.
            let relative = velocity[a] - velocity[b];
            let q = max(distance - ahead * (sqrt(inner(relative, relative)) + gained), 0.5 * distance) / pair.range;
            if q < 1.0 {
                let later = potential(pair, q);
                rate += pair.strength * max(abs(later.z), later.y / q) / (pair.range * pair.range);
            }
        }
#endif
        if distance >= pair.range {
            continue;
        }
#if colour_field
        if pair.law == COLOUR_FIELD {
            stiffness = pair.strength;
            let volumes = reference_volume[a] * reference_volume[b];
            let slope = gradient(distance, 0.5 * pair.range);
            force -= x * (pair.strength * volumes * (colour_excess[a] + colour_excess[b]) * slope);
        }
#endif
#if potentials
        if pair.law < COLOUR_FIELD {
            let at = potential(pair, distance / pair.range);
            energy += 0.5 * pair.strength * at.x;
            force += x * (pair.strength * at.y / (pair.range * distance));
        }
#endif
    }
#if colour_field
    energy += 0.5 * stiffness * reference_volume[a] * colour_excess[a] * colour_excess[a];
#endif
    contact_energy[a] = energy;
#if potentials
    contact_rate[a] = 2.0 * rate / mass(a);
#endif
    if listed > 0u {
        acceleration[a] += force * (1.0 / mass(a));
    }
}
