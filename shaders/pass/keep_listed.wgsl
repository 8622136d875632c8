// Keeps the displacements at which the list of facets is made. Twin: src/pass/keep_listed.rs
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> listed_displacement: array<Vec>;

fn of_particle(a: u32) {
    listed_displacement[a] = displacement[a];
}
