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

// A symmetric tensor for each axis.
struct Tri {
    x: Sym,
    y: Sym,
    z: Sym,
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
// The same numbers, hidden from the compiler: `zero` is always 0, but read from memory, so that nothing can be simplified.
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
// Products x_i x_j, each once.
fn products(x: Vec) -> Sym {
    return Sym(x.x * x.x, x.y * x.y, x.z * x.z, x.x * x.y, x.y * x.z, x.x * x.z);
}
// Component (i, s) is a_i b_s.
fn tri_outer(a: Vec, b: Sym) -> Tri {
    return Tri(sym_scale(b, a.x), sym_scale(b, a.y), sym_scale(b, a.z));
}
fn tri_add(a: Tri, b: Tri) -> Tri {
    return Tri(sym_add(a.x, b.x), sym_add(a.y, b.y), sym_add(a.z, b.z));
}
fn sym_dot(a: Sym, b: Sym) -> real {
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + a.xy * b.xy + a.yz * b.yz + a.xz * b.xz;
}
fn tri_sub(a: Tri, b: Tri) -> Tri {
    return Tri(sym_sub(a.x, b.x), sym_sub(a.y, b.y), sym_sub(a.z, b.z));
}
// Sum over s of T_is b_s.
fn tri_sym(t: Tri, b: Sym) -> Vec {
    return Vec(sym_dot(t.x, b), sym_dot(t.y, b), sym_dot(t.z, b));
}
// Sum over s of A_is B_js.
fn tri_tri(a: Tri, b: Tri) -> Mat {
    return Mat(tri_sym(a, b.x), tri_sym(a, b.y), tri_sym(a, b.z));
}
fn combined(t: Tri, factors: Vec) -> Sym {
    return sym_add(sym_add(sym_scale(t.x, factors.x), sym_scale(t.y, factors.y)), sym_scale(t.z, factors.z));
}
// Sum over j of M_ij T_js.
fn mat_tri(m: Mat, t: Tri) -> Tri {
    let rows = transpose(m);
    return Tri(combined(t, rows[0]), combined(t, rows[1]), combined(t, rows[2]));
}
// Numbers of a quadratic polynomial without its constant, and the place of each in Vec, Sym and Tri.
const TERMS: u32 = 9u;
fn term(d: Vec, products: Sym, k: u32) -> real {
    switch k {
        case 0u: { return d.x; }
        case 1u: { return d.y; }
        case 2u: { return d.z; }
        case 3u: { return products.xx; }
        case 4u: { return products.yy; }
        case 5u: { return products.zz; }
        case 6u: { return products.xy; }
        case 7u: { return products.yz; }
        default: { return products.xz; }
    }
}
fn sym_of_terms(m: ptr<function, array<real, 81>>, scale: real) -> Sym {
    return sym_scale(Sym((*m)[0], (*m)[10], (*m)[20], (*m)[1], (*m)[11], (*m)[2]), scale);
}
fn sym_of_column(m: ptr<function, array<real, 81>>, column: u32, scale: real) -> Sym {
    let first = 27u + column;
    return sym_scale(
        Sym((*m)[first], (*m)[first + 9u], (*m)[first + 18u], (*m)[first + 27u], (*m)[first + 36u], (*m)[first + 45u]),
        scale,
    );
}
fn tri_of_terms(m: ptr<function, array<real, 81>>, scale: real) -> Tri {
    return Tri(sym_of_column(m, 0u, scale), sym_of_column(m, 1u, scale), sym_of_column(m, 2u, scale));
}
