//! Maxwell body of Simo & Miehe 1992, Shutov & Klyuchantsev 2019 (14) to (16). Memory: C_i - 1.
//!
//! The elasticity of [`super::inelastic`] with the mean stress of [`super::hartmann_neff`], and
//! dC_i/dt = mu/eta X^D C_i. Twin: shaders/material/maxwell.wgsl

use super::hartmann_neff::{volumetric_energy, volumetric_stress};
use super::inelastic::{elastic_strain, isochoric_energy, relaxed};
use super::strain::volume_change;
use super::inelastic;
use super::point::Memory;
use crate::rows::Body;
use crate::tensor::{Real, Space};

super::law::law! {
    Maxwell, maxwell, Whole, "finite viscoelasticity of Simo & Miehe: neo-Hookean, and relaxes by `viscosity`";
    reads: [], remembers: [InelasticStrain];
    viscosity: VISCOSITY, Range::Positive, None, 1.0, "Newtonian viscosity: stress times time";
}

#[inline(always)]
pub fn first_piola<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Mat {
    inelastic::first_piola::<S>(body, h, memory, volumetric_stress(body.bulk_modulus, volume_change::<S>(h)))
}

pub fn stored_energy<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Real {
    isochoric_energy::<S>(body, h, memory) + volumetric_energy(body.bulk_modulus, volume_change::<S>(h))
}

/// Rate at which the body relaxes.
#[inline(always)]
fn relaxation<R: Real>(body: &Body<R>) -> R {
    body.shear_modulus / Maxwell::of(body).viscosity
}

/// The memory after a step that ends at H: the unimodular part of C_i + step mu/eta C', (16), implicit and without
/// iteration.
#[inline(always)]
pub fn relax<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: Memory<S>, step: S::Real) -> Memory<S> {
    Memory { strain: relaxed::<S>(h, memory.strain, step * relaxation(body)), ..memory }
}

/// Rate at which energy turns into heat, per reference volume: tr((C T)^D (C T)^D)/(2 eta) = mu^2/(2 eta) X^D:X^D.
pub fn dissipation<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: S::Sym) -> S::Real {
    let strain = elastic_strain::<S>(h, memory);
    let trace = strain.trace();
    let square = strain.inner(strain) - trace * trace * S::Real::of(1.0 / 3.0);
    S::Real::of(0.5) * body.shear_modulus * relaxation(body) * square
}
