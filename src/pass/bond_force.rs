//! Acceleration by the bonds of the reference configuration:
//!
//! rho_0 a_a = sum V_b (P_a K_a^-1 + P_b K_b^-1) grad_a W_ab + hourglass force,
//!
//! the gradient of the energy sum V_a [psi(F_a) + (alpha E/2) sum V_b w |F_a X_ab - x_ab|^2], w = -W'(R)/R. The
//! corrected F is the least-squares fit with these weights, so the derivative of the second term by F vanishes
//! and its force is only sum alpha E V_b w [2 u_ab - (H_a + H_b) X_ab], ab meaning b - a. The parts of both
//! terms that belong to one particle were put together in [`super::deform`].
//!
//! Twin: shaders/pass/bond_force.wgsl

use super::Stage;
use crate::pair::{bonds, displacement_difference, mirror_tensor};
use crate::smoothing::{Kernel, with_kernel};
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut accelerations = std::mem::take(&mut state.particles.acceleration);
    with_kernel!(state.method.smoothing, K => {
        super::write(&mut accelerations, |a, slot| *slot = sum::<S, K>(state, a));
    });
    state.particles.acceleration = accelerations;
}

#[inline(always)]
fn sum<S: Space, K: Kernel>(state: &State<S>, a: usize) -> S::Vec {
    let particles = &state.particles;
    // Sum of the weights alone: what a's own stress is multiplied with.
    let (mut own, mut others) = (S::Vec::default(), S::Vec::default());
    let body = state.body(a);
    let stiffness = state.params.hourglass * body.youngs_modulus;
    for bond in bonds::<S, K>(state, a) {
        let weight = bond.gradient * particles.reference_volume[bond.b];
        let x = bond.x * weight;
        own += x;
        let mut stress = particles.bond_stress[bond.b];
        if bond.image != 0 {
            stress = mirror_tensor::<S>(&state.params, bond.image, stress);
        }
        others += S::mat_vec(stress, x);
        if state.method.hourglass {
            let both = stiffness + state.params.hourglass * state.body(bond.b).youngs_modulus;
            others = others - displacement_difference(state, a, &bond) * (both * weight);
        }
    }
    (S::mat_vec(particles.bond_stress[a], own) + others) * (S::Real::of(1.0) / body.density)
}
