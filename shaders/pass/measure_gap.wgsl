// Distance of each facet from the surface that faces it, and what follows from it. A facet that presses on the other
// surface marks itself and the facets in its list as pressed. Twin: src/pass/measure_gap.rs
#import facet_pair
#import facet
#import stick if friction

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> facet_owner: array<u32>;
@group(0) @binding(_) var<storage, read> facet_reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_normal: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_area: array<real>;
@group(0) @binding(_) var<storage, read> facet_contacts: array<u32>;
@group(0) @binding(_) var<storage, read> facet_contact_count: array<u32>;
@group(0) @binding(_) var<storage, read_write> facet_pressed: array<atomic<u32>>;
@group(0) @binding(_) var<storage, read_write> facet_gap: array<real>;
@group(0) @binding(_) var<storage, read_write> facet_spread: array<real>;
@group(0) @binding(_) var<storage, read_write> facet_pull: array<real>;
@group(0) @binding(_) var<storage, read_write> facet_edge: array<real>;
@group(0) @binding(_) var<storage, read_write> facet_pressure: array<real>;
@group(0) @binding(_) var<storage, read_write> facet_energy: array<real>;
#if friction
@group(0) @binding(_) var<storage, read> facet_move: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_slip: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_traction: array<Vec>;
@group(0) @binding(_) var<storage, read_write> facet_heat: array<real>;
#endif

// The sums over the other surface: of weights, of weights times distances, of weights times moves and normals; and
// the numbers of the last pair.
struct Sums {
    weight: real,
    distance: real,
    moved: Vec,
    normal: Vec,
    pair: FacetPair,
}

fn of_facet(e: u32) {
    leave_alone(e);
    if facet_contact_count[e] == 0u {
        return;
    }
    let sums = sum_facing(e);
    let stiffness = sums.pair.stiffness * facet_area[e];
    let spread = select(0.0, 1.0 / sums.weight, sums.weight > 0.0);
    let gap = sums.distance * spread;
    facet_gap[e] = gap;
    if gap >= 0.0 {
#if friction
        // The facet has lost touch: what its tangential spring held becomes heat.
        facet_heat[e] = 0.5 * stiffness * inner(slip_before, slip_before);
#endif
        return;
    }
    let whole = fade(sums.weight / sums.pair.full);
    let half = 0.5 * stiffness * gap * gap;
    let force = -stiffness * gap * whole.x;
    facet_spread[e] = spread;
    facet_pull[e] = -force * spread;
    facet_edge[e] = half * whole.y / sums.pair.full;
    facet_pressure[e] = force / facet_area[e];
    var energy = half * whole.x;
#if friction
    if sums.pair.friction > 0.0 {
        let normal = sums.normal * (1.0 / sqrt(inner(sums.normal, sums.normal)));
        let grown = slip_before + facet_move[e] - sums.moved * spread;
        let along = grown - normal * inner(grown, normal);
        let stuck = stick(slip_before, along, stiffness, sums.pair.friction * force);
        facet_slip[e] = stuck.slip;
        facet_heat[e] = stuck.heat;
        facet_traction[e] = stuck.slip * -stiffness;
        energy += 0.5 * stiffness * inner(stuck.slip, stuck.slip);
    }
#endif
    facet_energy[e] = energy;
    if force != 0.0 {
        tell(e);
    }
}

fn tell(e: u32) {
    atomicStore(&facet_pressed[e], 1u);
    let listed = facet_contact_count[e];
    for (var k = 0u; k < listed; k++) {
        atomicStore(&facet_pressed[facet_contacts[k * params.facet_count + e]], 1u);
    }
}

#if friction
// Elastic slip when the step began.
var<private> slip_before: Vec;
#endif

// What the columns hold for a facet that is out of touch.
fn leave_alone(e: u32) {
    facet_gap[e] = 0.0;
    facet_spread[e] = 0.0;
    facet_pull[e] = 0.0;
    facet_edge[e] = 0.0;
    facet_pressure[e] = 0.0;
    facet_energy[e] = 0.0;
#if friction
    slip_before = facet_slip[e];
    facet_slip[e] = Vec();
    facet_traction[e] = Vec();
    facet_heat[e] = 0.0;
#endif
}

fn sum_facing(e: u32) -> Sums {
    let own = seat(e);
    let a = facet_owner[e];
    var sums = Sums();
    let listed = facet_contact_count[e];
    for (var k = 0u; k < listed; k++) {
        let f = facet_contacts[k * params.facet_count + e];
        let pair = listed_pair(a, f);
        sums.pair = pair;
        let near = facing(own, f, pair.range);
        if near.weight == 0.0 {
            continue;
        }
        sums.weight += near.weight;
        sums.distance += near.weight * inner(facet_normal[f], near.x);
#if friction
        sums.moved += facet_move[f] * near.weight;
        sums.normal += facet_normal[f] * near.weight;
#endif
    }
    return sums;
}
