// Adds the acceleration by contact, m_a a_a += sum strength/range (-phi'(r/range)) x_ab/r, and finds each
// particle's half of the pairs' energy. Twin: src/pass/contact_force.rs
#import invocation
#import separation
#import mass
#import contact_pair
#import potential

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> contacts: array<u32>;
@group(0) @binding(_) var<storage, read> contact_count: array<u32>;
@group(0) @binding(_) var<storage, read_write> contact_energy: array<real>;
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;

@compute @workgroup_size(64)
fn main(invocation: Invocation) {
    let a = index_of(invocation);
    if a >= params.count || clock.running == 0u {
        return;
    }
    let listed = contact_count[a];
    var energy: real = 0.0;
    var force = Vec();
    for (var k = 0u; k < listed; k++) {
        let b = contacts[k * params.count + a];
        let pair = contact_pair(a, b);
        let x = separation(reference_position[a], displacement[a], b, displacement[b]);
        let distance = sqrt(inner(x, x));
        if distance < pair.range {
            let at = potential(distance / pair.range);
            energy += 0.5 * pair.strength * at.x;
            force += x * (pair.strength * at.y / (pair.range * distance));
        }
    }
    contact_energy[a] = energy;
    if listed > 0u {
        acceleration[a] += force * (1.0 / mass(a));
    }
}
