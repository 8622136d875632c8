//! What a material answers to deformation. Twin: shaders/material/elastic.wgsl
//!
//! Today: the linear equation of state with the bulk modulus, and the hypoelastic deviator; further laws
//! join as pairs of files.

use crate::tensor::{Real, Space};

/// P = K (rho/rho_0 - 1) = -K e/(1 + e), e the volumetric strain. With the bulk modulus K, not rho c^2 of
/// p-waves: that is 62 % too stiff at a Poisson ratio of 0.3.
#[inline(always)]
pub fn pressure<R: Real>(bulk_modulus: R, volumetric_strain: R) -> R {
    -bulk_modulus * volumetric_strain / (R::of(1.0) + volumetric_strain)
}

/// 2 mu (D - tr D/3), Fuller (2.40); plane strain and uniaxial strain keep the third of the trace that the
/// missing axes carry.
#[inline(always)]
pub fn deviatoric_rate<S: Space>(shear_modulus: S::Real, velocity_gradient: S::Mat) -> S::Sym {
    let third = S::trace(velocity_gradient) * S::Real::of(1.0 / 3.0);
    (S::sym_part(velocity_gradient) - S::diagonal(third)) * (S::Real::of(2.0) * shear_modulus)
}

/// Elastic energy per reference volume: K (e - ln(1 + e)) + S:S/(4 mu) (1 + e), the full S:S in three dimensions.
pub fn elastic_energy(bulk_modulus: f64, shear_modulus: f64, volumetric_strain: f64, deviator_square: f64) -> f64 {
    let volumetric = bulk_modulus * (volumetric_strain - volumetric_strain.ln_1p());
    let deviatoric = if shear_modulus > 0.0 { deviator_square / (4.0 * shear_modulus) } else { 0.0 };
    volumetric + deviatoric * (1.0 + volumetric_strain)
}
