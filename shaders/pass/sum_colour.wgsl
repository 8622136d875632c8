// By how much the colour of the bodies that a particle touches exceeds the threshold, <sum V_b W_ab - c0>.
// Twin: src/pass/sum_colour.rs
#import separation
#import kernel
#import contact_pair

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> reference_position: array<Vec>;
@group(0) @binding(_) var<storage, read> reference_volume: array<real>;
@group(0) @binding(_) var<storage, read> displacement: array<Vec>;
@group(0) @binding(_) var<storage, read> contacts: array<u32>;
@group(0) @binding(_) var<storage, read> contact_count: array<u32>;
@group(0) @binding(_) var<storage, read_write> colour_excess: array<real>;

fn of_particle(a: u32) {
    let listed = contact_count[a];
    var colour: real = 0.0;
    var threshold: real = 0.0;
    for (var k = 0u; k < listed; k++) {
        let b = contacts[k * params.count + a];
        let pair = contact_pair(a, b);
        if pair.law == COLOUR_FIELD {
            let x = separation(reference_position[a], displacement[a], b, displacement[b]);
            threshold = pair.threshold;
            colour += reference_volume[b] * weight(sqrt(inner(x, x)), 0.5 * pair.range);
        }
    }
    colour_excess[a] = max(colour - threshold, 0.0);
}
