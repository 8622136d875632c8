//! H_a = [sum V_b (u_b - u_a) (x) grad_a W_ab] K_a^-1, the stress P_a of the material, and what the bonds carry of
//! it, P_a K_a^-1 - alpha E H_a. Twin: shaders/pass/deform.wgsl
//!
//! The sums run over the reference configuration. The second term is the part of the hourglass force that
//! belongs to one particle; see [`super::bond_force`].

use super::Stage;
use crate::bond::{Source, displacement_difference, with_bonds};
use crate::material;
use crate::scene::file::Gradient;
use crate::state::State;
use crate::tensor::Space;
use rayon::prelude::*;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut gradients = std::mem::take(&mut state.particles.displacement_gradient);
    let mut stresses = std::mem::take(&mut state.particles.bond_stress);
    with_bonds!(state, B => {
        let columns = gradients.par_iter_mut().zip(&mut stresses).enumerate();
        columns.with_min_len(super::GRAIN).for_each(|(a, (gradient, stress))| {
            *gradient = sum_bonds::<S, B>(state, a);
            (*gradient, *stress) = respond(state, a, gradient);
        });
    });
    state.particles.displacement_gradient = gradients;
    state.particles.bond_stress = stresses;
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

/// H and what the bonds carry. Out of line, so that the sums of the loop before stay in vector registers.
#[inline(never)]
fn respond<S: Space>(state: &State<S>, a: usize, sum: &S::Mat) -> (S::Mat, S::Mat) {
    let gradient = corrected(state, a, *sum);
    (gradient, bond_stress(state, a, gradient))
}

/// M K_a^-1
#[inline(always)]
fn corrected<S: Space>(state: &State<S>, a: usize, m: S::Mat) -> S::Mat {
    if state.method.gradient == Gradient::Plain {
        return m;
    }
    S::mat_mat(m, S::mat_of_sym(state.particles.reference_correction[a]))
}

#[inline(always)]
fn bond_stress<S: Space>(state: &State<S>, a: usize, gradient: S::Mat) -> S::Mat {
    let body = state.body(a);
    let memory = state.particles.viscous_strain.get(a).copied().unwrap_or_default();
    let stress = corrected(state, a, material::first_piola::<S>(body, gradient, memory));
    if !state.method.hourglass {
        return stress;
    }
    stress - gradient * (state.params.hourglass * body.youngs_modulus)
}
