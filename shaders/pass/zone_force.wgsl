// Adds the acceleration by zones: what owners do to a particle, less what it does to intruders as an owner, so that
// momentum is kept to the last digit. Twin: src/pass/zone_force.rs
#import mass

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> contacts: array<u32>;
@group(0) @binding(_) var<storage, read> contact_count: array<u32>;
@group(0) @binding(_) var<storage, read> surface: array<u32>;
@group(0) @binding(_) var<storage, read> zone_forces: array<Vec>;
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;

fn of_particle(a: u32) {
    let listed = contact_count[a];
    var force = Vec();
    for (var k = 0u; k < listed; k++) {
        let b = contacts[k * params.count + a];
        if surface[a] != 0u {
            force -= zone_forces[k * params.count + a];
        }
        if surface[b] != 0u {
            force += force_of(b, a);
        }
    }
    if listed > 0u {
        acceleration[a] += force * (1.0 / mass(a));
    }
}

// Force of an owner on an intruder.
fn force_of(owner: u32, intruder: u32) -> Vec {
    let listed = contact_count[owner];
    for (var k = 0u; k < listed; k++) {
        if contacts[k * params.count + owner] == intruder {
            return zone_forces[k * params.count + owner];
        }
    }
    return Vec();
}
