// How two particles' bodies touch. Twin: State::contact_pair in src/state.rs
#import params
#import body_index

@group(0) @binding(_) var<storage, read> contact_pairs: array<ContactPair>;

fn contact_pair(a: u32, b: u32) -> ContactPair {
    return contact_pairs[body_index(a) * params.body_count + body_index(b)];
}
