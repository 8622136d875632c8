// Vectors and tensors in space. Twin: Solid in src/tensor.rs
#import real

alias Vec = vec3<real>;
alias Mat = mat3x3<real>;
alias Mask = vec3<bool>;
const DIMENSION: u32 = 3u;

struct Sym {
    xx: real,
    yy: real,
    zz: real,
    xy: real,
    yz: real,
    xz: real,
}

fn vec_of(x: real, y: real, z: real) -> Vec {
    return Vec(x, y, z);
}
fn vec_to(v: Vec) -> vec3<real> {
    return v;
}
// Bit k of the mask: axis k.
fn mask_of(bits: u32) -> Mask {
    return (vec3<u32>(bits) & vec3<u32>(1u, 2u, 4u)) != vec3<u32>(0u);
}
// The same numbers, of which the compiler knows nothing if `zero` is a zero that it does not know.
fn hidden(v: Vec, zero: u32) -> Vec {
    return bitcast<Vec>(bitcast<vec3<u32>>(v) ^ vec3<u32>(zero));
}
fn inner(a: Vec, b: Vec) -> real {
    return dot(a, b);
}
// a (x) b: component (i, j) is a_i b_j.
fn outer(a: Vec, b: Vec) -> Mat {
    return Mat(a * b.x, a * b.y, a * b.z);
}
fn mat_vec(m: Mat, v: Vec) -> Vec {
    return m * v;
}
fn mat_mat(a: Mat, b: Mat) -> Mat {
    return a * b;
}
fn transpose_mat(m: Mat) -> Mat {
    return transpose(m);
}
fn sym_vec(s: Sym, v: Vec) -> Vec {
    return Vec(
        s.xx * v.x + s.xy * v.y + s.xz * v.z,
        s.xy * v.x + s.yy * v.y + s.yz * v.z,
        s.xz * v.x + s.yz * v.y + s.zz * v.z,
    );
}
fn sym_add(a: Sym, b: Sym) -> Sym {
    return Sym(a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.xz + b.xz);
}
fn sym_sub(a: Sym, b: Sym) -> Sym {
    return Sym(a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.xz - b.xz);
}
fn sym_scale(s: Sym, scale: real) -> Sym {
    return Sym(s.xx * scale, s.yy * scale, s.zz * scale, s.xy * scale, s.yz * scale, s.xz * scale);
}
fn mat_of_sym(s: Sym) -> Mat {
    return Mat(Vec(s.xx, s.xy, s.xz), Vec(s.xy, s.yy, s.yz), Vec(s.xz, s.yz, s.zz));
}
// (M + M^T)/2
fn sym_part(m: Mat) -> Sym {
    let shear = 0.5 * Vec(m[1].x + m[0].y, m[2].y + m[1].z, m[2].x + m[0].z);
    return Sym(m[0].x, m[1].y, m[2].z, shear.x, shear.y, shear.z);
}
// (M - M^T)/2
fn skew_part(m: Mat) -> Mat {
    return (m - transpose(m)) * 0.5;
}
fn trace(m: Mat) -> real {
    return m[0].x + m[1].y + m[2].z;
}
fn sym_trace(s: Sym) -> real {
    return s.xx + s.yy + s.zz;
}
// The unit tensor times a number.
fn diagonal(value: real) -> Sym {
    return Sym(value, value, value, 0.0, 0.0, 0.0);
}
fn mat_identity() -> Mat {
    return Mat(Vec(1.0, 0.0, 0.0), Vec(0.0, 1.0, 0.0), Vec(0.0, 0.0, 1.0));
}
fn determinant_mat(m: Mat) -> real {
    return m[0].x * (m[1].y * m[2].z - m[2].y * m[1].z) - m[1].x * (m[0].y * m[2].z - m[2].y * m[0].z)
        + m[2].x * (m[0].y * m[1].z - m[1].y * m[0].z);
}
// Transposed matrix of cofactors: the inverse times the determinant. Its rows are cross products of the columns.
fn adjugate(m: Mat) -> Mat {
    return transpose(Mat(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])));
}
