// Tells each facet the particle that carries it. Twin: src/pass/attach_facets.rs
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> first_facet: array<u32>;
@group(0) @binding(_) var<storage, read> facets: array<u32>;
@group(0) @binding(_) var<storage, read_write> facet_owner: array<u32>;

fn of_particle(a: u32) {
    let end = first_facet[a] + facets[a];
    for (var e = first_facet[a]; e < end; e++) {
        facet_owner[e] = a;
    }
}
