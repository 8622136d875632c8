// u_b - u_a, the neighbour's displacement mirrored if it is an image. The pass declares `displacement`.
// Twin: displacement_difference in src/bond.rs
#import bond

fn displacement_difference(displacement_a: Vec, bond: Bond) -> Vec {
    var displacement_b = displacement[bond.b];
#if symmetry
    if bond.image != 0u {
        displacement_b = mirror_vector(bond.image, displacement_b);
    }
#endif
    return displacement_b - displacement_a;
}
