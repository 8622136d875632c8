// Vectors and tensors in the plane. Twin: Plane in src/tensor.rs
#import real

alias Vec = vec2<real>;
alias Mat = mat2x2<real>;
alias Mask = vec2<bool>;
const DIMENSION: u32 = 2u;

struct Sym {
    xx: real,
    yy: real,
    xy: real,
}

// A symmetric tensor for each axis.
struct Tri {
    x: Sym,
    y: Sym,
}

fn vec_of(x: real, y: real, z: real) -> Vec {
    return Vec(x, y);
}
fn vec_to(v: Vec) -> vec3<real> {
    return vec3<real>(v, 0.0);
}
// Bit k of the mask: axis k.
fn mask_of(bits: u32) -> Mask {
    return (vec2<u32>(bits) & vec2<u32>(1u, 2u)) != vec2<u32>(0u);
}
// The same numbers, hidden from the compiler: `zero` is always 0, but read from memory, so that nothing can be simplified.
fn hidden(v: Vec, zero: u32) -> Vec {
    return bitcast<Vec>(bitcast<vec2<u32>>(v) ^ vec2<u32>(zero));
}
fn inner(a: Vec, b: Vec) -> real {
    return dot(a, b);
}
// a (x) b: component (i, j) is a_i b_j.
fn outer(a: Vec, b: Vec) -> Mat {
    return Mat(a * b.x, a * b.y);
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
    return Vec(s.xx * v.x + s.xy * v.y, s.xy * v.x + s.yy * v.y);
}
fn sym_add(a: Sym, b: Sym) -> Sym {
    return Sym(a.xx + b.xx, a.yy + b.yy, a.xy + b.xy);
}
fn sym_sub(a: Sym, b: Sym) -> Sym {
    return Sym(a.xx - b.xx, a.yy - b.yy, a.xy - b.xy);
}
fn sym_scale(s: Sym, scale: real) -> Sym {
    return Sym(s.xx * scale, s.yy * scale, s.xy * scale);
}
fn mat_of_sym(s: Sym) -> Mat {
    return Mat(Vec(s.xx, s.xy), Vec(s.xy, s.yy));
}
// (M + M^T)/2
fn sym_part(m: Mat) -> Sym {
    return Sym(m[0].x, m[1].y, 0.5 * (m[1].x + m[0].y));
}
// (M - M^T)/2
fn skew_part(m: Mat) -> Mat {
    return (m - transpose(m)) * 0.5;
}
fn trace(m: Mat) -> real {
    return m[0].x + m[1].y;
}
// Sum of the diagonal components that are stored: xx + yy.
fn sym_trace(s: Sym) -> real {
    return s.xx + s.yy;
}
// The unit tensor times a number.
fn diagonal(value: real) -> Sym {
    return Sym(value, value, 0.0);
}
fn mat_identity() -> Mat {
    return Mat(Vec(1.0, 0.0), Vec(0.0, 1.0));
}
fn determinant_mat(m: Mat) -> real {
    return m[0].x * m[1].y - m[1].x * m[0].y;
}
// Transposed matrix of cofactors: the inverse times the determinant.
fn adjugate(m: Mat) -> Mat {
    return Mat(Vec(m[1].y, -m[0].y), Vec(-m[1].x, m[0].x));
}
// Products x_i x_j, each once.
fn products(x: Vec) -> Sym {
    return Sym(x.x * x.x, x.y * x.y, x.x * x.y);
}
// Component (i, s) is a_i b_s.
fn tri_outer(a: Vec, b: Sym) -> Tri {
    return Tri(sym_scale(b, a.x), sym_scale(b, a.y));
}
fn tri_add(a: Tri, b: Tri) -> Tri {
    return Tri(sym_add(a.x, b.x), sym_add(a.y, b.y));
}
fn sym_dot(a: Sym, b: Sym) -> real {
    return a.xx * b.xx + a.yy * b.yy + a.xy * b.xy;
}
fn tri_sub(a: Tri, b: Tri) -> Tri {
    return Tri(sym_sub(a.x, b.x), sym_sub(a.y, b.y));
}
// Sum over s of T_is b_s.
fn tri_sym(t: Tri, b: Sym) -> Vec {
    return Vec(sym_dot(t.x, b), sym_dot(t.y, b));
}
// Sum over s of A_is B_js.
fn tri_tri(a: Tri, b: Tri) -> Mat {
    return Mat(tri_sym(a, b.x), tri_sym(a, b.y));
}
// Sum over j of M_ij T_js.
fn mat_tri(m: Mat, t: Tri) -> Tri {
    return Tri(
        sym_add(sym_scale(t.x, m[0].x), sym_scale(t.y, m[1].x)),
        sym_add(sym_scale(t.x, m[0].y), sym_scale(t.y, m[1].y)),
    );
}
// Numbers of a quadratic polynomial without its constant, and the place of each in Vec, Sym and Tri.
const TERMS: u32 = 5u;
fn term(d: Vec, products: Sym, k: u32) -> real {
    switch k {
        case 0u: { return d.x; }
        case 1u: { return d.y; }
        case 2u: { return products.xx; }
        case 3u: { return products.yy; }
        default: { return products.xy; }
    }
}
fn sym_of_terms(m: ptr<function, array<real, 25>>, scale: real) -> Sym {
    return Sym((*m)[0] * scale, (*m)[6] * scale, (*m)[1] * scale);
}
fn tri_of_terms(m: ptr<function, array<real, 25>>, scale: real) -> Tri {
    return Tri(
        Sym((*m)[10] * scale, (*m)[15] * scale, (*m)[20] * scale),
        Sym((*m)[11] * scale, (*m)[16] * scale, (*m)[21] * scale),
    );
}
