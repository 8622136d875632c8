//! Rates of volumetric strain, Fuller (2.21), and of deviatoric stress, (2.45), for the Runge-Kutta stages.
//! Twin: shaders/pass/stress_rate.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::material;
use crate::method::Density;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "rates of volumetric strain and deviatoric stress, Fuller (2.21), (2.45)",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[VelocityGradient]),
            when(|m| m.shears() && m.many_bodies, &[Body]),
            when(|m| m.shears(), &[DeviatoricStress]),
            when(|m| m.continuity(), &[VolumetricStrain]),
        ],
        neighbours: &[],
        writes: &[when(|m| m.shears(), &[DeviatoricStressRate]), when(|m| m.continuity(), &[VolumetricStrainRate])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.method.shear {
        fill!(state, deviatoric_stress_rate, |a, slot| {
            let gradient = state.columns.velocity_gradient[a];
            let spun = S::mat_mat(S::skew_part(gradient), S::mat_of_sym(state.columns.deviatoric_stress[a]));
            // Omega S - S Omega is twice the symmetric part of Omega S.
            let rotation = S::sym_part(spun) * S::Real::of(2.0);
            *slot = material::deviatoric_rate::<S>(state.body(a).shear_modulus, gradient) + rotation;
        });
    }
    if state.method.density == Density::Continuity {
        fill!(state, volumetric_strain_rate, |a, slot| {
            let trace = S::trace(state.columns.velocity_gradient[a]);
            *slot = (S::Real::of(1.0) + state.columns.volumetric_strain[a]) * trace;
        });
    }
}
