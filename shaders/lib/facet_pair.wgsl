// How the surfaces of two particles' bodies touch. Twin: State::facet_pair in src/state.rs
#import params
#import body_index

@group(0) @binding(_) var<storage, read> facet_pairs: array<FacetPair>;

// How the surface of particle a touches facet f, which is in the list of one of a's.
fn listed_pair(a: u32, f: u32) -> FacetPair {
    if params.facet_alike > 0u {
        return facet_pairs[params.facet_alike - 1u];
    }
    return facet_pair(a, facet_owner[f]);
}

fn facet_pair(a: u32, b: u32) -> FacetPair {
    return facet_pairs[body_index(a) * params.body_count + body_index(b)];
}
