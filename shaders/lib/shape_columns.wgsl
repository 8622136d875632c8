// The correction of a particle, as it was last made, and a neighbour's vectors. Twin: src/shape_function.rs
#import shape
#import mirror if symmetry

#if correction
@group(0) @binding(_) var<storage, read> shape_factor: array<real>;
@group(0) @binding(_) var<storage, read> shape_slope: array<Vec>;
@group(0) @binding(_) var<storage, read> shape_factor_gradient: array<Vec>;
@group(0) @binding(_) var<storage, read> shape_slope_gradient: array<Mat>;
#endif

fn shape_of(a: u32) -> Shape {
#if correction
    return Shape(shape_factor[a], shape_slope[a], shape_factor_gradient[a], shape_slope_gradient[a]);
#else
    return Shape(1.0, Vec(), Vec(), Mat());
#endif
}

// A neighbour's vector, mirrored if it is an image.
fn seen(image: u32, v: Vec) -> Vec {
#if symmetry
    if image != 0u {
        return mirror_vector(image, v);
    }
#endif
    return v;
}
