// Lists the facets that each facet may touch before the list is made anew: near, facing, and of another body or far
// apart in the reference configuration. Twin: src/pass/find_facet_contacts.rs
#import visit_cells
#import facet_pair
#import facet

@group(0) @binding(_) var<storage, read_write> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> first_facet: array<u32>;
@group(0) @binding(_) var<storage, read> facets: array<u32>;
@group(0) @binding(_) var<storage, read> facet_owner: array<u32>;
@group(0) @binding(_) var<storage, read> facet_reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_normal: array<Vec>;
@group(0) @binding(_) var<storage, read> cell_start: array<u32>;
@group(0) @binding(_) var<storage, read> cell_particles: array<u32>;
@group(0) @binding(_) var<storage, read_write> facet_contacts: array<u32>;
@group(0) @binding(_) var<storage, read_write> facet_contact_count: array<u32>;

// Largest n_e.n_f that enters the list: facets that stand across each other hardly touch.
const MOST_TURN: real = -0.05;

// The facet whose contacts are sought.
struct Search {
    e: u32,
    a: u32,
    own: Seat,
}

fn of_facet(e: u32) {
    let own = seat(e);
    let found = visit_cells(Search(e, facet_owner[e], own), own.reference + own.displacement, 0u);
    if found == TOO_MANY {
        facet_contact_count[e] = 0u;
        clock.fault = LIST_FULL;
    } else {
        facet_contact_count[e] = found;
    }
}

// Lists those facets of a stretch of particles that may touch.
fn visit(search: Search, first: u32, end: u32, found_before: u32) -> u32 {
    var found = found_before;
    for (var k = first; k < end; k++) {
        let b = cell_particles[k];
        if may_touch(search.a, b) {
            found = visit_facets(search, first_facet[b], first_facet[b] + facets[b], found);
            if found == TOO_MANY {
                return TOO_MANY;
            }
        }
    }
    return found;
}

fn visit_facets(search: Search, first: u32, end: u32, found_before: u32) -> u32 {
    var found = found_before;
    for (var f = first; f < end; f++) {
        let x = facet_separation(search.own, f);
        let near = inner(x, x) < params.facet_reach * params.facet_reach;
        if !near || inner(search.own.normal, facet_normal[f]) >= MOST_TURN {
            continue;
        }
        if found == params.facet_capacity {
            return TOO_MANY;
        }
        facet_contacts[found * params.facet_count + search.e] = f;
        found += 1u;
    }
    return found;
}

// Whether the facets of two particles may touch.
fn may_touch(a: u32, b: u32) -> bool {
    if facet_pair(a, b).stiffness == 0.0 {
        return false;
    }
    let apart = reference_position[a] - reference_position[b];
    return body_index(a) != body_index(b) || inner(apart, apart) > params.contact_apart * params.contact_apart;
}
