//! What every kernel has.

use crate::tensor::Real;

/// One smoothing kernel in its dimensionless form.
pub trait Kernel: Copy + Send + Sync + 'static {
    /// C_1, C_2, C_3: the integral of W over the line, the plane and space is 1.
    const NORMALISATION: [f64; 3];
    /// w(q) for 0 <= q; zero from q = 2 on.
    fn shape<R: Real>(q: R) -> R;
    /// dw/dq for 0 <= q; zero from q = 2 on.
    fn slope<R: Real>(q: R) -> R;
}
