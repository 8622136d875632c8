// Force of each surface particle, the owner of a zone, on each particle in its list of contacts, Fuller (4.2) and (4.3).
// Zero where the other is not inside. Twin: src/pass/push_intruders.rs
#import own_neighbor
#import contact_pair
#import zones

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
#if zones_friction
@group(0) @binding(_) var<storage, read> velocity: array<Vec>;
#endif
@group(0) @binding(_) var<storage, read> contacts: array<u32>;
@group(0) @binding(_) var<storage, read> contact_count: array<u32>;
@group(0) @binding(_) var<storage, read> surface: array<u32>;
@group(0) @binding(_) var<storage, read> surface_normal: array<Vec>;
@group(0) @binding(_) var<storage, read_write> zone_forces: array<Vec>;

fn of_particle(a: u32, row: u32) {
    if surface[a] == 0u {
        return;
    }
    let listed = contact_count[a];
    for (var k = 0u; k < listed; k++) {
        zone_forces[k * params.count + a] = push(a, row, contacts[k * params.count + a]);
    }
}

// Force on intruder b by owner a.
fn push(a: u32, row: u32, b: u32) -> Vec {
    let pair = contact_pair(a, b);
    // x_b - x_a
    let place = -separation(reference_position[a], displacement[a], b, displacement[b]);
    let normal = surface_normal[a];
    if pair.law != ZONES || inner(normal, normal) == 0.0 || !in_zone(place, normal, pair.range) {
        return Vec();
    }
    if surface[a] == CORNER && outside_some(a, row, place, pair.range) {
        return Vec();
    }
    let size = pair.strength * penalty(abs(inner(place, normal)) / pair.range);
#if zones_friction
    let apart = velocity[b] - velocity[a];
    let slip = apart - normal * inner(apart, normal);
    let speed = sqrt(inner(slip, slip));
    if speed > 0.0 {
        return (normal - slip * (pair.friction / speed)) * size;
    }
#endif
    return normal * size;
}

// Whether a place lies outside a zone with the normal of some surface particle in the kernel's range of a corner.
fn outside_some(a: u32, row: u32, place: Vec, half: real) -> bool {
    let listed = neighbor_count[a];
    for (var k = 0u; k < listed; k++) {
        let c = neighbors[k * params.chunk + row];
        let normal = surface_normal[c];
        if inner(normal, normal) > 0.0 && own_neighbor(a, c).within && !in_zone(place, normal, half) {
            return true;
        }
    }
    return false;
}
