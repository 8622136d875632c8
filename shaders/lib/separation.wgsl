// x_a - x_b. The pass declares `reference_position`. Twin: separation in src/pair.rs
#import params
#import mirror if symmetry

#if periodic
// Shortens a separation to the nearest periodic image.
fn nearest_image(x: Vec) -> Vec {
    let period = vec_of(params.period_x, params.period_y, params.period_z);
    // An open axis has period 0: nothing is taken off.
    let divisor = select(period, Vec(1.0), period <= Vec(0.0));
    return x - period * round(x / divisor);
}
#endif

// From reference positions and displacements apart, so that f32 keeps the small difference. The first two
// arguments are those of particle a, which a loop over neighbours loads once; the last is the neighbour's.
fn separation(reference_a: Vec, displacement_a: Vec, entry: u32, displacement_b: Vec) -> Vec {
    let b = entry & NEIGHBOR_MASK;
    var reference = reference_position[b];
    var shift = displacement_b;
#if symmetry
    let image = entry >> NEIGHBOR_BITS;
    if image != 0u {
        reference = mirror_point(image, reference);
        shift = mirror_vector(image, shift);
    }
#endif
    let x = (reference_a - reference) + (displacement_a - shift);
#if periodic
    return nearest_image(x);
#else
    return x;
#endif
}
