//! What a material answers to deformation: one file a law, and here the list of them.
//!
//! In the Eulerian formulation: the linear equation of state with the bulk modulus, and the hypoelastic deviator.
//! In the Total Lagrangian: first Piola-Kirchhoff stress from H = F - 1, written for small H in f32.
//! Twin: shaders/material/

pub mod hardening;
pub mod j2;
pub mod maxwell;
pub mod neo_hookean;
pub mod st_venant_kirchhoff;
pub mod strain;

use crate::rows::Body;
use crate::tensor::{Real, Space};
use serde::{Deserialize, Serialize};

/// Names the laws; the number is what [`Body::law`] holds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// Linear equation of state and hypoelastic deviator: Eulerian only.
    #[default]
    Elastic,
    /// Linear equation of state alone: Eulerian only.
    Fluid,
    /// Stress linear in Green's strain.
    StVenantKirchhoff,
    /// Deviator of Simo, volumetric part of Hartmann & Neff 2003: Shutov & Klyuchantsev 2019 (11), (12).
    NeoHookean,
    /// Maxwell body of Simo & Miehe 1992: Shutov & Klyuchantsev 2019 (14) to (16).
    Maxwell,
    /// Metal that flows where the Mises stress reaches the yield stress.
    J2,
}

/// What a law remembers: the inelastic strain C_i - 1, and the equivalent plastic strain.
pub type Memory<S> = (<S as Space>::Sym, <S as Space>::Real);

impl Law {
    pub const ALL: &'static [Law] = &[Law::Elastic, Law::Fluid, Law::StVenantKirchhoff, Law::NeoHookean, Law::Maxwell, Law::J2];
    pub fn about(self) -> &'static str {
        match self {
            Law::Elastic => "linear equation of state and hypoelastic deviator, Eulerian: the default",
            Law::Fluid => "linear equation of state alone, Eulerian",
            Law::StVenantKirchhoff => "stress linear in Green's strain: large rotations, small strains",
            Law::NeoHookean => "neo-Hookean deviator, volumetric part of Hartmann & Neff: large strains",
            Law::Maxwell => "finite viscoelasticity of Simo & Miehe: neo-Hookean, and relaxes by `viscosity`",
            Law::J2 => {
                "metal plasticity: flows where the Mises stress reaches `yield_stress`, which may harden; in both formulations"
            }
        }
    }
    /// Gives stress from the deformation gradient.
    pub fn is_finite_strain(self) -> bool {
        !matches!(self, Law::Elastic | Law::Fluid)
    }
    /// Gives stress from rates.
    pub fn is_hypoelastic(self) -> bool {
        matches!(self, Law::Elastic | Law::Fluid | Law::J2)
    }
    /// Stress depends on more than the deformation.
    pub fn has_memory(self) -> bool {
        matches!(self, Law::Maxwell | Law::J2)
    }
    /// Word in scenes, and stem of the law's files.
    pub fn word(self) -> &'static str {
        match self {
            Law::Elastic => "elastic",
            Law::Fluid => "fluid",
            Law::StVenantKirchhoff => "st_venant_kirchhoff",
            Law::NeoHookean => "neo_hookean",
            Law::Maxwell => "maxwell",
            Law::J2 => "j2",
        }
    }
}

const NEO_HOOKEAN: u32 = Law::NeoHookean as u32;
const MAXWELL: u32 = Law::Maxwell as u32;
const J2: u32 = Law::J2 as u32;

/// First Piola-Kirchhoff stress of the deformation 1 + H. `memory` is the inelastic strain C_i - 1 of a law
/// that remembers. This and the next two come to a shader as `src/backend/shader/laws.rs` writes them.
#[inline(always)]
pub fn first_piola<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Mat {
    match body.law {
        NEO_HOOKEAN => neo_hookean::first_piola::<S>(body, h),
        MAXWELL | J2 => maxwell::first_piola::<S>(body, h, memory),
        _ => st_venant_kirchhoff::first_piola::<S>(body, h),
    }
}

/// Memory after a step that ends at the deformation 1 + H.
#[inline(always)]
pub fn relax<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: Memory<S>, step: S::Real) -> Memory<S> {
    match body.law {
        MAXWELL => (maxwell::relax::<S>(body, h, memory.0, step), memory.1),
        J2 => j2::relax::<S>(body, h, memory),
        _ => memory,
    }
}

/// Heat of one step, plastic work included, per reference volume, from H and memory before and after it.
#[inline(always)]
pub fn dissipated<S: Space>(body: &Body<S::Real>, before: (S::Mat, S::Sym), after: (S::Mat, S::Sym)) -> S::Real {
    if body.law == MAXWELL || body.law == J2 { maxwell::dissipated::<S>(body, before, after) } else { S::Real::of(0.0) }
}

/// Elastic energy per reference volume of the deformation 1 + H.
pub fn stored_energy<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Real {
    match body.law {
        NEO_HOOKEAN => neo_hookean::stored_energy::<S>(body, h),
        MAXWELL | J2 => maxwell::stored_energy::<S>(body, h, memory),
        _ => st_venant_kirchhoff::stored_energy::<S>(body, h),
    }
}

/// True stress P F^T/J.
pub fn cauchy<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Sym {
    let one = S::Real::of(1.0);
    let kirchhoff = S::mat_mat(first_piola::<S>(body, h, memory), S::transpose(S::mat_identity() + h));
    S::sym_part(kirchhoff) * (one / (one + strain::volume_change::<S>(h)))
}

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
