// Adds the acceleration by the facets that a particle carries, and finds the energy and the heat of their contact.
// Twin: src/pass/surface_force.rs
#import mass
#import facet_touched

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> first_facet: array<u32>;
@group(0) @binding(_) var<storage, read> facets: array<u32>;
@group(0) @binding(_) var<storage, read> facet_force: array<Vec>;
@group(0) @binding(_) var<storage, read> facet_energy: array<real>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read_write> contact_energy: array<real>;
@group(0) @binding(_) var<storage, read_write> acceleration: array<Vec>;
#if friction
#if dissipated_energy
@group(0) @binding(_) var<storage, read> facet_heat: array<real>;
@group(0) @binding(_) var<storage, read_write> dissipated_energy: array<real>;
#endif
#endif

fn of_particle(a: u32) {
    var force = Vec();
    var energy: real = 0.0;
    let end = first_facet[a] + facets[a];
    for (var e = first_facet[a]; e < end; e++) {
        if facet_touched(e) {
            force += facet_force[e];
            energy += facet_energy[e];
        }
    }
#if contact
    contact_energy[a] += energy;
#else
    contact_energy[a] = energy;
#endif
    if facets[a] == 0u {
        return;
    }
    acceleration[a] += force * (1.0 / mass(a));
#if friction
#if dissipated_energy
    var heat: real = 0.0;
    for (var e = first_facet[a]; e < end; e++) {
        heat += facet_heat[e];
    }
    dissipated_energy[a] += heat / mass(a);
#endif
#endif
}
