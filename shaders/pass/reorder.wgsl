// Moves a carried field into cell order, so that neighbours in space are neighbours in memory; dispatched once
// for each field, of `words` numbers a particle. Twin: src/pass/reorder.rs
#import params

@group(0) @binding(_) var<storage, read> clock: Clock;
@group(0) @binding(_) var<storage, read> cell_particles: array<u32>;
@group(0) @binding(_) var<storage, read> source: array<u32>;
@group(0) @binding(_) var<storage, read_write> destination: array<u32>;

override words: u32;

fn of_particle(i: u32) {
    // The pass copies even when the segment is over: the host takes the destination for the field in any case.
    var place = i;
    if clock.running != 0u {
        place = cell_particles[i];
    }
    for (var w = 0u; w < words; w++) {
        destination[i * words + w] = source[place * words + w];
    }
}
