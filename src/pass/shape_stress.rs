//! Stress from the deformation gradient, as the gradients of the shape functions carry it: in the current
//! configuration Kirchhoff's, J times Cauchy's, so that V_b sigma_b of Shutov & Klyuchantsev 2019 (5) is the reference
//! volume times it; in the reference configuration the first Piola-Kirchhoff stress. And J - 1, for the present
//! volumes. A law that remembers takes its memory to the end of the step first. Twin: shaders/pass/shape_stress.wgsl

use super::Stage;
use crate::material::{self, strain};
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let step = state.clock.step;
    let mut memories = std::mem::take(&mut state.columns.inelastic_strain);
    let gradients = &state.columns.displacement_gradient;
    super::write(&mut memories, |a, memory| {
        *memory = material::relax::<S>(state.body(a), gradients[a], (*memory, S::Real::of(0.0)), step).0;
    });
    state.columns.inelastic_strain = memories;
    let mut stresses = std::mem::take(&mut state.columns.shape_stress);
    super::write(&mut stresses, |a, slot| *slot = stress(state, a));
    state.columns.shape_stress = stresses;
    let mut strains = std::mem::take(&mut state.columns.volumetric_strain);
    super::write(&mut strains, |a, slot| *slot = strain::volume_change::<S>(state.columns.displacement_gradient[a]));
    state.columns.volumetric_strain = strains;
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
