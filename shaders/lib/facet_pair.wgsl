// How the surfaces of two particles' bodies touch. Twin: State::facet_pair in src/state.rs
#import params
#import body_index

@group(0) @binding(_) var<storage, read> facet_pairs: array<FacetPair>;

fn facet_pair(a: u32, b: u32) -> FacetPair {
    return facet_pairs[body_index(a) * params.body_count + body_index(b)];
}
