// Lists the particles that each particle may touch before the list is made anew: near in the present configuration,
// and of another body or far apart in the reference configuration. Twin: src/pass/find_contacts.rs
#import visit_cells
#import separation
#import contact_pair

@group(0) @binding(_) var<storage, read_write> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> cell_start: array<u32>;
@group(0) @binding(_) var<storage, read> cell_particles: array<u32>;
@group(0) @binding(_) var<storage, read_write> listed_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> contacts: array<u32>;
@group(0) @binding(_) var<storage, read_write> contact_count: array<u32>;

// The particle whose contacts are sought.
struct Search {
    a: u32,
    reference: Vec,
    displacement: Vec,
}

fn of_particle(a: u32) {
    let search = Search(a, reference_position[a], displacement[a]);
    listed_displacement[a] = search.displacement;
    let found = visit_cells(search, search.reference + search.displacement, 0u);
    if found == TOO_MANY {
        contact_count[a] = 0u;
        clock.fault = LIST_FULL;
    } else {
        contact_count[a] = found;
    }
}

// Lists those of a stretch of particles that may touch.
fn visit(search: Search, first: u32, end: u32, found_before: u32) -> u32 {
    var found = found_before;
    for (var k = first; k < end; k++) {
        let b = cell_particles[k];
        let apart = separation(search.reference, search.displacement, b, displacement[b]);
        let near = inner(apart, apart) < params.contact_reach * params.contact_reach;
        if !near || b == search.a || !may_touch(search, b) {
            continue;
        }
        if found == params.contact_capacity {
            return TOO_MANY;
        }
        contacts[found * params.count + search.a] = b;
        found += 1u;
    }
    return found;
}

fn may_touch(search: Search, b: u32) -> bool {
    if contact_pair(search.a, b).range == 0.0 {
        return false;
    }
    let apart = separation(search.reference, Vec(), b, Vec());
    return body_index(search.a) != body_index(b) || inner(apart, apart) > params.contact_apart * params.contact_apart;
}
