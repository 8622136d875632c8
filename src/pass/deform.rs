//! H_a = [sum V_b (u_b - u_a) (x) grad_a W_ab] K_a^-1, the stress P_a of the material, and what the bonds carry of
//! it, P_a K_a^-1 - alpha E H_a. Twin: shaders/pass/deform.wgsl
//!
//! The sums run over the reference configuration. The second term is the part of the hourglass force that
//! belongs to one particle; see [`super::bond_force`]. In between, a law that remembers takes its memory to the
//! end of the step.

use super::Stage;
use crate::bond::{Source, displacement_difference, with_bonds};
use crate::material;
use crate::scene::file::Gradient;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut gradients = std::mem::take(&mut state.particles.displacement_gradient);
    let before = if state.method.memory() && state.method.dissipated_energy { gradients.clone() } else { Vec::new() };
    with_bonds!(state, B => {
        super::write(&mut gradients, |a, slot| {
            *slot = sum_bonds::<S, B>(state, a);
            *slot = corrected(state, a, slot);
        });
    });
    state.particles.displacement_gradient = gradients;
    relax(state, &before);
    let mut stresses = std::mem::take(&mut state.particles.bond_stress);
    super::write(&mut stresses, |a, slot| *slot = bond_stress(state, a));
    state.particles.bond_stress = stresses;
}

/// Takes what the laws remember to the end of the step, at the new H. Before the first step the clock's is 0.
fn relax<S: Space>(state: &mut State<S>, before: &[S::Mat]) {
    let step = state.clock.step;
    let mut memories = std::mem::take(&mut state.particles.viscous_strain);
    let mut heats = if before.is_empty() { Vec::new() } else { std::mem::take(&mut state.particles.dissipated_energy) };
    let old = if before.is_empty() { Vec::new() } else { memories.clone() };
    let gradients = &state.particles.displacement_gradient;
    super::write(&mut memories, |a, memory| *memory = material::relax::<S>(state.body(a), gradients[a], *memory, step));
    super::write(&mut heats, |a, heat| {
        let body = state.body(a);
        let heat_of_step = material::dissipated::<S>(body, (before[a], old[a]), (gradients[a], memories[a]));
        *heat += heat_of_step * (S::Real::of(1.0) / body.density);
    });
    state.particles.viscous_strain = memories;
    if !before.is_empty() {
        state.particles.dissipated_energy = heats;
    }
}

#[inline(always)]
fn sum_bonds<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> S::Mat {
    let mut sum = S::Mat::default();
    for block in B::blocks(state, a) {
        for bond in block {
            sum += S::outer(displacement_difference::<S, B>(state, a, &bond), bond.row.gradient);
        }
    }
    sum
}

/// M K_a^-1. Out of line, so that the sums of the loop over bonds stay in vector registers.
#[inline(never)]
fn corrected<S: Space>(state: &State<S>, a: usize, m: &S::Mat) -> S::Mat {
    if state.method.gradient == Gradient::Plain {
        return *m;
    }
    S::mat_mat(*m, S::mat_of_sym(state.particles.reference_correction[a]))
}

#[inline(always)]
fn bond_stress<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let (body, gradient) = (state.body(a), state.particles.displacement_gradient[a]);
    let memory = state.particles.viscous_strain.get(a).copied().unwrap_or_default();
    let stress = corrected(state, a, &material::first_piola::<S>(body, gradient, memory));
    if !state.method.hourglass {
        return stress;
    }
    stress - gradient * (state.params.hourglass * body.youngs_modulus)
}
