// v_b - v_a, the neighbour's velocity mirrored if it is an image. The pass declares `velocity`.
// Twin: velocity_difference in src/pair.rs
#import pair

fn velocity_difference(velocity_a: Vec, pair: Pair) -> Vec {
    var v_b = velocity[pair.b];
#if symmetry
    if pair.image != 0u {
        v_b = mirror_vector(pair.image, v_b);
    }
#endif
    return v_b - velocity_a;
}
