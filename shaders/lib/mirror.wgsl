// Mirror images in the symmetry planes: bit k of an image, plane k. Twin: src/pair.rs
#import params

fn normal_of(plane: vec4<real>) -> Vec {
    return vec_of(plane.x, plane.y, plane.z);
}

// Mirrors a vector, a velocity or displacement, in each plane of the image.
fn mirror_vector(image: u32, vector: Vec) -> Vec {
    var v = vector;
    for (var k = 0u; k < 3u; k++) {
        if ((image >> k) & 1u) == 1u {
            let n = normal_of(params.planes[k]);
            v -= n * (2.0 * inner(v, n));
        }
    }
    return v;
}

// Mirrors a point in each plane of the image.
fn mirror_point(image: u32, point: Vec) -> Vec {
    var x = point;
    for (var k = 0u; k < 3u; k++) {
        if ((image >> k) & 1u) == 1u {
            let n = normal_of(params.planes[k]);
            x -= n * (2.0 * (inner(x, n) - params.planes[k].w));
        }
    }
    return x;
}

// Mirrors a tensor: H M H with H = 1 - 2 n (x) n.
fn mirror_tensor(image: u32, tensor: Mat) -> Mat {
    var m = tensor;
    for (var k = 0u; k < 3u; k++) {
        if ((image >> k) & 1u) == 1u {
            let n = normal_of(params.planes[k]);
            let h = mat_identity() - outer(n, n) * 2.0;
            m = mat_mat(h, mat_mat(m, h));
        }
    }
    return m;
}
