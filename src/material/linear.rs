//! Linear equation of state: p = K (rho/rho_0 - 1) = -K e/(1 + e), e = J - 1 the volumetric strain. With the bulk modulus
//! K, not rho c^2 of p-waves: that is 62 % too stiff at a Poisson ratio of 0.3. The mean Kirchhoff stress is K e.
//! Twin: shaders/material/linear.wgsl

use crate::rows::Body;
use crate::tensor::Real;

super::law::law! {
    Linear, linear, Pressure, "pressure linear in the density";
    reads: [], remembers: [];
}

/// Mean Kirchhoff stress -J p from J - 1.
#[inline(always)]
pub fn kirchhoff<R: Real>(body: &Body<R>, volume_change: R) -> R {
    body.bulk_modulus * volume_change
}

/// Energy per reference volume, K (e - ln(1 + e)).
pub fn stored<R: Real>(body: &Body<R>, volume_change: R) -> R {
    let e = volume_change.f64();
    R::of(body.bulk_modulus.f64() * (e - e.ln_1p()))
}
