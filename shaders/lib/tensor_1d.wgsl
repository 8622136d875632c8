// Vectors and tensors on a line: all are numbers. Twin: Line in src/tensor.rs
#import real

alias Vec = real;
alias Mat = real;
alias Sym = real;
alias Tri = real;
alias Mask = bool;
const DIMENSION: u32 = 1u;

fn vec_of(x: real, y: real, z: real) -> Vec {
    return x;
}
fn vec_to(v: Vec) -> vec3<real> {
    return vec3<real>(v, 0.0, 0.0);
}
// Bit k of the mask: axis k.
fn mask_of(bits: u32) -> Mask {
    return (bits & 1u) != 0u;
}
// The same number, hidden from the compiler: `zero` is always 0, but read from memory, so that nothing can be simplified.
fn hidden(v: Vec, zero: u32) -> Vec {
    return bitcast<real>(bitcast<u32>(v) ^ zero);
}
fn inner(a: Vec, b: Vec) -> real {
    return a * b;
}
fn outer(a: Vec, b: Vec) -> Mat {
    return a * b;
}
fn mat_vec(m: Mat, v: Vec) -> Vec {
    return m * v;
}
fn mat_mat(a: Mat, b: Mat) -> Mat {
    return a * b;
}
fn transpose_mat(m: Mat) -> Mat {
    return m;
}
fn sym_vec(s: Sym, v: Vec) -> Vec {
    return s * v;
}
fn sym_add(a: Sym, b: Sym) -> Sym {
    return a + b;
}
fn sym_sub(a: Sym, b: Sym) -> Sym {
    return a - b;
}
fn sym_scale(s: Sym, scale: real) -> Sym {
    return s * scale;
}
fn mat_of_sym(s: Sym) -> Mat {
    return s;
}
fn sym_part(m: Mat) -> Sym {
    return m;
}
fn skew_part(m: Mat) -> Mat {
    return 0.0;
}
fn trace(m: Mat) -> real {
    return m;
}
fn sym_trace(s: Sym) -> real {
    return s;
}
fn diagonal(value: real) -> Sym {
    return value;
}
fn mat_identity() -> Mat {
    return 1.0;
}
fn determinant_mat(m: Mat) -> real {
    return m;
}
fn adjugate(m: Mat) -> Mat {
    return 1.0;
}
// Products x_i x_j, each once.
fn products(x: Vec) -> Sym {
    return x * x;
}
// Component (i, s) is a_i b_s.
fn tri_outer(a: Vec, b: Sym) -> Tri {
    return a * b;
}
fn tri_add(a: Tri, b: Tri) -> Tri {
    return a + b;
}
fn tri_sub(a: Tri, b: Tri) -> Tri {
    return a - b;
}
// Sum over s of T_is b_s.
fn tri_sym(t: Tri, b: Sym) -> Vec {
    return t * b;
}
// Sum over s of A_is B_js.
fn tri_tri(a: Tri, b: Tri) -> Mat {
    return a * b;
}
// Sum over j of M_ij T_js.
fn mat_tri(m: Mat, t: Tri) -> Tri {
    return m * t;
}
// Numbers of a quadratic polynomial without its constant, and the place of each in Vec, Sym and Tri.
const TERMS: u32 = 2u;
fn term(d: Vec, products: Sym, k: u32) -> real {
    return select(products, d, k == 0u);
}
fn sym_of_terms(m: ptr<function, array<real, 4>>, scale: real) -> Sym {
    return (*m)[0] * scale;
}
fn tri_of_terms(m: ptr<function, array<real, 4>>, scale: real) -> Tri {
    return (*m)[2] * scale;
}
