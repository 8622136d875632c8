// Separation of a facet from its particle in the reference configuration. Twin: lever in src/facet.rs
#import tensor

@group(0) @binding(_) var<storage, read> facet_owner: array<u32>;
@group(0) @binding(_) var<storage, read> facet_reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;

fn lever(e: u32) -> Vec {
    return facet_reference_position[e] - reference_position[facet_owner[e]];
}
