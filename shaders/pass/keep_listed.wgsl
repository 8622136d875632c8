// Keeps the displacements at which the list of facets is made. Twin: src/pass/keep_listed.rs
#import invocation
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read_write> listed_displacement: array<Vec>;

@compute @workgroup_size(64)
fn main(invocation: Invocation) {
    let a = index_of(invocation);
    if a >= params.count || clock.running == 0u || clock.rebuild == 0u {
        return;
    }
    listed_displacement[a] = displacement[a];
}
