//! Stress from the deformation gradient, as the gradients of the shape functions carry it: in the current
//! configuration Kirchhoff's, J times Cauchy's, so that V_b sigma_b of Shutov & Klyuchantsev 2019 (5) is the reference
//! volume times it; in the reference configuration the first Piola-Kirchhoff stress. And J - 1, for the present
//! volumes. A law that remembers takes its memory to the end of the step first. Twin: shaders/pass/shape_stress.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::material::{self, Memory, strain};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "stress that the gradients of the shape functions carry",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[always(&[DisplacementGradient]), when(|m| m.many_bodies, &[Body]), when(|m| m.memory(), &[InelasticStrain])],
        neighbours: &[],
        writes: &[always(&[ShapeStress]), when(|m| m.memory(), &[InelasticStrain]), when(|m| m.current(), &[VolumetricStrain])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let step = state.clock.step;
    fill!(state, inelastic_strain, |a, memory| {
        let gradient = state.columns.displacement_gradient[a];
        *memory = material::relax::<S>(state.body(a), gradient, Memory { strain: *memory, ..Memory::default() }, step).strain;
    });
    fill!(state, shape_stress, |a, slot| *slot = stress(state, a));
    fill!(state, volumetric_strain, |a, slot| {
        *slot = strain::volume_change::<S>(state.columns.displacement_gradient[a]);
    });
}

#[inline(always)]
fn stress<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let gradient = state.columns.displacement_gradient[a];
    let memory = state.columns.inelastic_strain.get(a).copied().unwrap_or_default();
    let stress = material::first_piola::<S>(state.body(a), gradient, memory);
    if !state.method.list_follows() {
        return stress;
    }
    stress + S::mat_mat(stress, S::transpose(gradient))
}
