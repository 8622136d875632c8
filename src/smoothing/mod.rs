//! Smoothing kernels W(r, h) = C_D / h^D w(q), q = r/h, all supported on q < 2.
//!
//! A kernel is a pair of files: `src/smoothing/x.rs` and `shaders/smoothing/x.wgsl`, and one line in the
//! list below. The constants C_1, C_2, C_3 live here only; a shader receives the one of its dimension.

mod cubic_spline;
mod gaussian;
mod kernel;
mod quadratic;
mod wendland;

pub use cubic_spline::CubicSpline;
pub use gaussian::Gaussian;
pub use kernel::Kernel;
pub use quadratic::Quadratic;
pub use wendland::Wendland;

use crate::tensor::Real;
use serde::Deserialize;

macro_rules! kernels {
    ($($word:ident: $name:ident, $about:literal;)*) => {
        /// The kernels by the word that a scene uses.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Smoothing { $($name),* }

        impl Smoothing {
            pub const ALL: &'static [Smoothing] = &[$(Smoothing::$name),*];
            /// Word in the scene, stem of the two files.
            pub fn word(self) -> &'static str {
                match self { $(Smoothing::$name => stringify!($word)),* }
            }
            pub fn about(self) -> &'static str {
                match self { $(Smoothing::$name => $about),* }
            }
            /// C_D of the given dimension.
            pub fn normalisation(self, dimension: usize) -> f64 {
                match self { $(Smoothing::$name => $name::NORMALISATION[dimension - 1]),* }
            }
            /// W(r, h), for the host's own sums.
            pub fn value(self, r: f64, h: f64, dimension: usize) -> f64 {
                let w = match self { $(Smoothing::$name => $name::shape(r / h)),* };
                self.normalisation(dimension) * w / h.powi(dimension as i32)
            }
            /// dW/dr (r, h), for the host's own sums.
            pub fn derivative(self, r: f64, h: f64, dimension: usize) -> f64 {
                let w = match self { $(Smoothing::$name => $name::slope(r / h)),* };
                self.normalisation(dimension) * w / h.powi(dimension as i32 + 1)
            }
            /// The shader twin's source.
            pub fn source(self) -> &'static str {
                match self {
                    $(Smoothing::$name => include_str!(concat!("../../shaders/smoothing/", stringify!($word), ".wgsl"))),*
                }
            }
        }

        /// Runs `$body` with `$K` naming the type of the kernel that `$smoothing` holds.
        macro_rules! with_kernel {
            ($smoothing:expr, $K:ident => $body:expr) => {
                match $smoothing {
                    $(Smoothing::$name => { type $K = $name; $body })*
                }
            };
        }
    };
}

kernels! {
    cubic_spline: CubicSpline, "cubic B-spline of Monaghan & Lattanzio 1985: Fuller (2.5), the default";
    quadratic: Quadratic, "Johnson 1996: slope grows towards the centre, so that close pairs still repel";
    gaussian: Gaussian, "cut at q = 2 and renormalised on that support";
    wendland: Wendland, "quintic C2 of Wendland 1995: no pairing of particles";
}

/// Pairs that the passes evaluate together: enough for the widest vector registers.
pub const LANES: usize = 8;

/// Kernel and its numbers for one dimension and precision, as the pair loops use it.
///
/// Which kernel it is, is asked at each call, not once for a whole loop: each pass is then compiled once, not once for
/// each kernel. The loops over many pairs ask once for [`LANES`] of them.
#[derive(Debug, Clone, Copy)]
pub struct Scaled<R> {
    smoothing: Smoothing,
    normalisation: R,
    dimension: usize,
}

impl<R: Real> Scaled<R> {
    #[inline(always)]
    pub fn new(smoothing: Smoothing, dimension: usize) -> Self {
        Self { smoothing, normalisation: R::of(smoothing.normalisation(dimension)), dimension }
    }
    #[inline(always)]
    fn power(&self, h: R) -> R {
        match self.dimension {
            1 => h,
            2 => h * h,
            _ => h * h * h,
        }
    }
    /// W(r, h), in 1/length^D.
    #[inline(always)]
    pub fn weight(&self, r: R, h: R) -> R {
        self.normalisation * with_kernel!(self.smoothing, K => K::shape(r / h)) / self.power(h)
    }
    /// [`Self::weight`] of several pairs.
    #[inline(always)]
    pub fn weights(&self, r: &[R; LANES], h: &[R; LANES]) -> [R; LANES] {
        let mut weights = *r;
        with_kernel!(self.smoothing, K => for lane in 0..LANES {
            weights[lane] = self.normalisation * K::shape(r[lane] / h[lane]) / self.power(h[lane]);
        });
        weights
    }
    /// (dW/dr)/r, the factor of the separation in the gradient, in 1/length^(D+2). Finite at r = 0, where a
    /// particle may meet its own mirror image.
    #[inline(always)]
    pub fn gradient(&self, r: R, h: R) -> R {
        let (inverse, factor) = (R::of(1.0) / h, self.gradient_factor(h));
        with_kernel!(self.smoothing, K => gradient_at::<K, R>(r, h, inverse, factor))
    }
    /// What [`Self::gradient`] needs of h alone.
    #[inline(always)]
    pub fn gradient_factor(&self, h: R) -> R {
        self.normalisation / (self.power(h) * h)
    }
    /// [`Self::gradient`] of several pairs, with 1/h and [`Self::gradient_factor`] of each.
    #[inline(always)]
    pub fn gradients(&self, r: &[R; LANES], h: &[R; LANES], inverse: &[R; LANES], factor: &[R; LANES]) -> [R; LANES] {
        // A plain loop, which the compiler turns into vector instructions.
        let mut gradients = *r;
        with_kernel!(self.smoothing, K => for lane in 0..LANES {
            gradients[lane] = gradient_at::<K, R>(r[lane], h[lane], inverse[lane], factor[lane]);
        });
        gradients
    }
}

/// (dW/dr)/r with the parts that depend on h alone given.
#[inline(always)]
fn gradient_at<K: Kernel, R: Real>(r: R, h: R, inverse: R, factor: R) -> R {
    factor * K::slope(r * inverse) / r.max(R::of(1e-6) * h)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gauss-Legendre with eight points on each of many intervals that respect the knots at 1 and 2.
    fn integral(f: impl Fn(f64) -> f64) -> f64 {
        const X: [f64; 4] = [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_2];
        const W: [f64; 4] = [0.362_683_783_378_362, 0.313_706_645_877_887_3, 0.222_381_034_453_374_48, 0.101_228_536_290_376_26];
        let step = 1.0 / 32.0;
        (0..64)
            .map(|k| {
                let (mid, half) = ((k as f64 + 0.5) * step, 0.5 * step);
                (0..4).map(|i| W[i] * (f(mid - half * X[i]) + f(mid + half * X[i]))).sum::<f64>() * half
            })
            .sum()
    }

    #[test]
    fn every_kernel_integrates_to_one() {
        use std::f64::consts::PI;
        for &kernel in Smoothing::ALL {
            for dimension in 1..=3 {
                let shell = |r: f64| [2.0, 2.0 * PI * r, 4.0 * PI * r * r][dimension - 1];
                let h = 0.7;
                let sum = h * integral(|q| kernel.value(q * h, h, dimension) * shell(q * h));
                assert!((sum - 1.0).abs() < 1e-12, "{kernel:?} in {dimension}D: {sum}");
            }
        }
    }

    #[test]
    fn every_slope_is_the_derivative_of_its_shape() {
        for &kernel in Smoothing::ALL {
            for k in 1..400 {
                let (q, step) = (k as f64 * 0.005 + 0.0013, 1e-5);
                let seen = kernel.derivative(q, 1.0, 2);
                let difference = (kernel.value(q + step, 1.0, 2) - kernel.value(q - step, 1.0, 2)) / (2.0 * step);
                // The truncated Gaussian jumps at the end of its support: no derivative there.
                if q < 2.0 - 2.0 * step {
                    assert!((seen - difference).abs() < 1e-8, "{kernel:?} at {q}: {seen} {difference}");
                }
            }
        }
    }

    #[test]
    fn every_kernel_ends_at_two_and_falls_before() {
        for &kernel in Smoothing::ALL {
            assert_eq!(kernel.value(2.0, 1.0, 3), 0.0);
            assert_eq!(kernel.derivative(2.5, 1.0, 3), 0.0);
            for k in 1..199 {
                assert!(kernel.derivative(k as f64 * 0.01, 1.0, 3) < 0.0, "{kernel:?} {k}");
            }
        }
    }
}
