//! Vectors and tensors of one, two and three dimensions, generic over f32 and f64, laid out in memory
//! as the shaders lay them out (`shaders/lib/tensor_*.wgsl`), so that a column can be copied as bytes.
//!
//! A twin is written once, generic over [`Space`], and runs in six variants: [`Line`], [`Plane`] and
//! [`Solid`] in each precision. Plane means plane strain: a deviator's zz follows from its zero trace,
//! so only xx, yy and xy are stored; on a line only xx is.

mod tuple;

pub use tuple::{Linear, Tuple};

use std::fmt::Debug;
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A scalar: f32 (as on the GPU) or f64 (as on the CPU path).
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + bytemuck::Pod
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + 'static
{
    /// Distance from one to the next number above it.
    const EPSILON: f64;
    fn of(value: f64) -> Self;
    fn f64(self) -> f64;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn floor(self) -> Self;
    fn round(self) -> Self;
    fn powf(self, exponent: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    fn is_finite(self) -> bool;
}

macro_rules! real {
    ($t:ident) => {
        impl Real for $t {
            const EPSILON: f64 = $t::EPSILON as f64;
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $t
            }
            #[inline(always)]
            fn f64(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn exp(self) -> Self {
                self.exp()
            }
            #[inline(always)]
            fn ln(self) -> Self {
                self.ln()
            }
            #[inline(always)]
            fn floor(self) -> Self {
                self.floor()
            }
            #[inline(always)]
            fn round(self) -> Self {
                self.round_ties_even()
            }
            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                self.powf(exponent)
            }
            // A bare comparison, as the shaders' min and max: cheaper than IEEE's care for NaN.
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if other < self { other } else { self }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if other > self { other } else { self }
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                self.is_finite()
            }
        }
    };
}
real!(f32);
real!(f64);

/// A dimension and a precision. Operations have the names that the shaders use.
pub trait Space: Copy + Send + Sync + 'static {
    type Real: Real;
    type Vec: Linear<Self::Real>;
    /// Column-major; columns have the stride of a vector.
    type Mat: Linear<Self::Real>;
    /// xx in 1D; xx, yy, xy in 2D; xx, yy, zz, xy, yz, xz in 3D.
    type Sym: Linear<Self::Real>;
    /// A symmetric tensor for each axis: what acts on the products of two components.
    type Tri: Linear<Self::Real>;
    /// Row k holds the numbers of a quadratic polynomial without its constant: axes, then products as in `Sym`.
    type Quadratic: Linear<Self::Real>;
    const DIMENSION: usize;
    /// Where component (row, column) of a symmetric tensor is stored.
    fn sym_index(row: usize, column: usize) -> usize;

    #[inline(always)]
    fn mat_index(row: usize, column: usize) -> usize {
        column * Self::Vec::LENGTH + row
    }
    #[inline(always)]
    fn inner(a: Self::Vec, b: Self::Vec) -> Self::Real {
        let mut sum = a[0] * b[0];
        for k in 1..Self::DIMENSION {
            sum += a[k] * b[k];
        }
        sum
    }
    /// a (x) b: component (i, j) is a_i b_j.
    #[inline(always)]
    fn outer(a: Self::Vec, b: Self::Vec) -> Self::Mat {
        let mut m = Self::Mat::default();
        for j in 0..Self::DIMENSION {
            for i in 0..Self::DIMENSION {
                m[Self::mat_index(i, j)] = a[i] * b[j];
            }
        }
        m
    }
    /// Products x_i x_j, each once.
    #[inline(always)]
    fn products(x: Self::Vec) -> Self::Sym {
        let mut s = Self::Sym::default();
        for i in 0..Self::DIMENSION {
            for j in 0..=i {
                s[Self::sym_index(i, j)] = x[i] * x[j];
            }
        }
        s
    }
    /// Component (i, s) is a_i b_s.
    #[inline(always)]
    fn tri_outer(a: Self::Vec, b: Self::Sym) -> Self::Tri {
        let mut t = Self::Tri::default();
        for i in 0..Self::DIMENSION {
            for s in 0..Self::Sym::LENGTH {
                t[i * Self::Sym::LENGTH + s] = a[i] * b[s];
            }
        }
        t
    }
    /// Sum over s of T_is b_s.
    #[inline(always)]
    fn tri_sym(t: Self::Tri, b: Self::Sym) -> Self::Vec {
        let mut v = Self::Vec::default();
        for i in 0..Self::DIMENSION {
            for s in 0..Self::Sym::LENGTH {
                v[i] += t[i * Self::Sym::LENGTH + s] * b[s];
            }
        }
        v
    }
    /// Sum over s of A_is B_js.
    #[inline(always)]
    fn tri_tri(a: Self::Tri, b: Self::Tri) -> Self::Mat {
        let mut m = Self::Mat::default();
        for i in 0..Self::DIMENSION {
            for j in 0..Self::DIMENSION {
                for s in 0..Self::Sym::LENGTH {
                    m[Self::mat_index(i, j)] += a[i * Self::Sym::LENGTH + s] * b[j * Self::Sym::LENGTH + s];
                }
            }
        }
        m
    }
    /// Sum over j of M_ij T_js.
    #[inline(always)]
    fn mat_tri(m: Self::Mat, t: Self::Tri) -> Self::Tri {
        let mut product = Self::Tri::default();
        for i in 0..Self::DIMENSION {
            for j in 0..Self::DIMENSION {
                for s in 0..Self::Sym::LENGTH {
                    product[i * Self::Sym::LENGTH + s] += m[Self::mat_index(i, j)] * t[j * Self::Sym::LENGTH + s];
                }
            }
        }
        product
    }
    #[inline(always)]
    fn mat_vec(m: Self::Mat, v: Self::Vec) -> Self::Vec {
        let mut out = Self::Vec::default();
        for j in 0..Self::DIMENSION {
            for i in 0..Self::DIMENSION {
                out[i] += m[Self::mat_index(i, j)] * v[j];
            }
        }
        out
    }
    #[inline(always)]
    fn mat_mat(a: Self::Mat, b: Self::Mat) -> Self::Mat {
        let mut m = Self::Mat::default();
        for j in 0..Self::DIMENSION {
            for k in 0..Self::DIMENSION {
                for i in 0..Self::DIMENSION {
                    m[Self::mat_index(i, j)] += a[Self::mat_index(i, k)] * b[Self::mat_index(k, j)];
                }
            }
        }
        m
    }
    #[inline(always)]
    fn transpose(m: Self::Mat) -> Self::Mat {
        let mut out = Self::Mat::default();
        for j in 0..Self::DIMENSION {
            for i in 0..Self::DIMENSION {
                out[Self::mat_index(i, j)] = m[Self::mat_index(j, i)];
            }
        }
        out
    }
    #[inline(always)]
    fn sym_vec(s: Self::Sym, v: Self::Vec) -> Self::Vec {
        let mut out = Self::Vec::default();
        for i in 0..Self::DIMENSION {
            for j in 0..Self::DIMENSION {
                out[i] += s[Self::sym_index(i, j)] * v[j];
            }
        }
        out
    }
    #[inline(always)]
    fn mat_of_sym(s: Self::Sym) -> Self::Mat {
        let mut m = Self::Mat::default();
        for j in 0..Self::DIMENSION {
            for i in 0..Self::DIMENSION {
                m[Self::mat_index(i, j)] = s[Self::sym_index(i, j)];
            }
        }
        m
    }
    /// (M + M^T)/2
    #[inline(always)]
    fn sym_part(m: Self::Mat) -> Self::Sym {
        let mut s = Self::Sym::default();
        let half = Self::Real::of(0.5);
        for j in 0..Self::DIMENSION {
            for i in 0..=j {
                s[Self::sym_index(i, j)] = half * (m[Self::mat_index(i, j)] + m[Self::mat_index(j, i)]);
            }
        }
        s
    }
    /// (M - M^T)/2
    #[inline(always)]
    fn skew_part(m: Self::Mat) -> Self::Mat {
        (m - Self::transpose(m)) * Self::Real::of(0.5)
    }
    #[inline(always)]
    fn trace(m: Self::Mat) -> Self::Real {
        let mut sum = m[0];
        for k in 1..Self::DIMENSION {
            sum += m[Self::mat_index(k, k)];
        }
        sum
    }
    /// Sum of the diagonal components that are stored (in the plane: xx + yy).
    #[inline(always)]
    fn sym_trace(s: Self::Sym) -> Self::Real {
        let mut sum = s[0];
        for k in 1..Self::DIMENSION {
            sum += s[k];
        }
        sum
    }
    /// The unit tensor times a number.
    #[inline(always)]
    fn diagonal(value: Self::Real) -> Self::Sym {
        let mut s = Self::Sym::default();
        for k in 0..Self::DIMENSION {
            s[k] = value;
        }
        s
    }
    #[inline(always)]
    fn mat_identity() -> Self::Mat {
        Self::mat_of_sym(Self::diagonal(Self::Real::of(1.0)))
    }
    fn determinant(m: Self::Mat) -> Self::Real;
    /// Transposed matrix of cofactors: the inverse times the determinant.
    fn adjugate(m: Self::Mat) -> Self::Mat;

    /// The first components of three.
    fn vec_of_reals(components: [Self::Real; 3]) -> Self::Vec {
        let mut v = Self::Vec::default();
        for (k, component) in components.into_iter().enumerate().take(Self::DIMENSION) {
            v[k] = component;
        }
        v
    }
    fn vec_from(components: [f64; 3]) -> Self::Vec {
        let mut v = Self::Vec::default();
        for k in 0..Self::DIMENSION {
            v[k] = Self::Real::of(components[k]);
        }
        v
    }
    /// Components along x, y, z; axes that the space lacks are zero.
    fn vec_to(v: Self::Vec) -> [f64; 3] {
        let mut out = [0.0; 3];
        for (k, slot) in out.iter_mut().enumerate().take(Self::DIMENSION) {
            *slot = v[k].f64();
        }
        out
    }
}

/// One dimension (uniaxial strain).
#[derive(Debug, Clone, Copy)]
pub struct Line<R>(PhantomData<R>);
/// Two dimensions (plane strain).
#[derive(Debug, Clone, Copy)]
pub struct Plane<R>(PhantomData<R>);
/// Three dimensions. Vectors carry a fourth number, always zero, as a vec3 does in a storage buffer.
#[derive(Debug, Clone, Copy)]
pub struct Solid<R>(PhantomData<R>);

impl<R: Real> Space for Line<R> {
    type Real = R;
    type Vec = Tuple<R, 1>;
    type Mat = Tuple<R, 1>;
    type Sym = Tuple<R, 1>;
    type Tri = Tuple<R, 1>;
    type Quadratic = Tuple<R, 4>;
    const DIMENSION: usize = 1;
    #[inline(always)]
    fn sym_index(_: usize, _: usize) -> usize {
        0
    }
    #[inline(always)]
    fn determinant(m: Self::Mat) -> R {
        m[0]
    }
    #[inline(always)]
    fn adjugate(_: Self::Mat) -> Self::Mat {
        Tuple([R::of(1.0)])
    }
}

impl<R: Real> Space for Plane<R> {
    type Real = R;
    type Vec = Tuple<R, 2>;
    type Mat = Tuple<R, 4>;
    type Sym = Tuple<R, 3>;
    type Tri = Tuple<R, 6>;
    type Quadratic = Tuple<R, 25>;
    const DIMENSION: usize = 2;
    #[inline(always)]
    fn sym_index(row: usize, column: usize) -> usize {
        if row == column { row } else { 2 }
    }
    #[inline(always)]
    fn sym_vec(s: Self::Sym, v: Self::Vec) -> Self::Vec {
        let ([xx, yy, xy], [x, y]) = (s.0, v.0);
        Tuple([xx * x + xy * y, xy * x + yy * y])
    }
    #[inline(always)]
    fn mat_of_sym(s: Self::Sym) -> Self::Mat {
        let [xx, yy, xy] = s.0;
        Tuple([xx, xy, xy, yy])
    }
    #[inline(always)]
    fn determinant(m: Self::Mat) -> R {
        m[0] * m[3] - m[2] * m[1]
    }
    #[inline(always)]
    fn adjugate(m: Self::Mat) -> Self::Mat {
        Tuple([m[3], -m[1], -m[2], m[0]])
    }
}

impl<R: Real> Space for Solid<R> {
    type Real = R;
    type Vec = Tuple<R, 4>;
    type Mat = Tuple<R, 12>;
    type Sym = Tuple<R, 6>;
    type Tri = Tuple<R, 18>;
    type Quadratic = Tuple<R, 81>;
    const DIMENSION: usize = 3;
    #[inline(always)]
    fn sym_index(row: usize, column: usize) -> usize {
        [[0, 3, 5], [3, 1, 4], [5, 4, 2]][row][column]
    }
    // In whole columns of four, padding included, these become vector instructions.
    #[inline(always)]
    fn inner(a: Self::Vec, b: Self::Vec) -> R {
        (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
    }
    #[inline(always)]
    fn outer(a: Self::Vec, b: Self::Vec) -> Self::Mat {
        let mut m = [R::default(); 12];
        for j in 0..3 {
            for i in 0..4 {
                m[4 * j + i] = a[i] * b[j];
            }
        }
        Tuple(m)
    }
    #[inline(always)]
    fn mat_vec(m: Self::Mat, v: Self::Vec) -> Self::Vec {
        Tuple(std::array::from_fn(|i| m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2]))
    }
    // Written out: looked up through `sym_index` this product alone took two thirds of the force loop.
    #[inline(always)]
    fn sym_vec(s: Self::Sym, v: Self::Vec) -> Self::Vec {
        let [xx, yy, zz, xy, yz, xz] = s.0;
        let [x, y, z, _] = v.0;
        Tuple([xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z, R::default()])
    }
    #[inline(always)]
    fn mat_of_sym(s: Self::Sym) -> Self::Mat {
        let ([xx, yy, zz, xy, yz, xz], zero) = (s.0, R::default());
        Tuple([xx, xy, xz, zero, xy, yy, yz, zero, xz, yz, zz, zero])
    }
    #[inline(always)]
    fn determinant(m: Self::Mat) -> R {
        m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) + m[8] * (m[1] * m[6] - m[5] * m[2])
    }
    #[inline(always)]
    fn adjugate(m: Self::Mat) -> Self::Mat {
        let minor = |a: usize, b: usize, c: usize, d: usize| m[a] * m[d] - m[b] * m[c];
        let zero = R::default();
        Tuple([
            minor(5, 9, 6, 10),
            minor(9, 1, 10, 2),
            minor(1, 5, 2, 6),
            zero,
            minor(8, 4, 10, 6),
            minor(0, 8, 2, 10),
            minor(4, 0, 6, 2),
            zero,
            minor(4, 8, 5, 9),
            minor(8, 0, 9, 1),
            minor(0, 4, 1, 5),
            zero,
        ])
    }
}

#[cfg(test)]
mod tests;
