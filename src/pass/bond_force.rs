//! Acceleration by the bonds of the reference configuration:
//!
//! rho_0 a_a = sum V_b (P_a K_a^-1 + P_b K_b^-1) grad_a W_ab + hourglass force,
//!
//! the gradient of the energy sum V_a [psi(F_a) + (alpha E/2) sum V_b w |F_a X_ab - x_ab|^2], w = -W'(R)/R. The
//! corrected F is the least-squares fit with these weights, so the derivative of the second term by F vanishes
//! and its force is only sum alpha E V_b w [2 u_ab - (H_a + H_b) X_ab], ab meaning b - a. The parts of both
//! terms that belong to one particle were put together in [`super::deform`]. Where a body has flowed, each end has its
//! own alpha, see [`hourglass_stiffness`].
//!
//! Where bodies are tied, each part of a bond's force has the weight of the end whose part it is: see [`crate::bond`].
//!
//! The quadratic-exact gradient adds sum (P_a C2_a - P_b C2_b) V_b w X_ab X_ab, see [`super::correct_quadratic`].
//!
//! Twin: shaders/pass/bond_force.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::bond::{Source, displacement_difference, far_weight, hourglass_stiffness, with_bonds};
use crate::method::Gradient;
use crate::pair::mirror_tensor;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "acceleration by the bonds of the reference configuration",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, BondStress, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.hourglass, &[Displacement]),
            when(|m| m.hourglass && m.plastic() && m.quasi_static.is_some(), &[EquilibriumPlasticStrain]),
            when(|m| m.hourglass && m.plastic() && m.quasi_static.is_none(), &[EquivalentPlasticStrain]),
            when(|m| m.quadratic_gradient(), &[QuadraticStress]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, BondStress]),
            when(|m| m.hourglass, &[Displacement]),
            when(|m| m.hourglass && m.plastic() && m.quasi_static.is_some(), &[EquilibriumPlasticStrain]),
            when(|m| m.hourglass && m.plastic() && m.quasi_static.is_none(), &[EquivalentPlasticStrain]),
            when(|m| m.tied || (m.hourglass && m.plastic() && m.body_options && m.many_bodies), &[Body]),
            when(|m| m.quadratic_gradient(), &[QuadraticStress]),
        ],
        writes: &[always(&[Acceleration])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_bonds!(state, B => fill!(state, acceleration, |a, slot| *slot = sum::<S, B>(state, a)));
}

#[inline(always)]
fn sum<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> S::Vec {
    let columns = &state.columns;
    // `own` is the sum of the kernel gradients alone: a's own stress multiplies it once, after the loop.
    let (mut own, mut others) = (S::Vec::default(), S::Vec::default());
    let body = state.body(a);
    // Where nothing flows and no bodies are tied, both ends of a bond have the same stiffness.
    let (stiffness, differ) = (hourglass_stiffness(state, a), state.method.plastic() || state.method.tied);
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            let mut stress = columns.bond_stress[bond.b];
            if B::IMAGES && bond.image != 0 {
                stress = mirror_tensor::<S>(&state.params, bond.image, stress);
            }
            own += bond.row.gradient;
            let far = far_weight::<S, B>(state, a, bond.b);
            let carried = S::mat_vec(stress, bond.row.gradient);
            others += if B::TIES { carried * far } else { carried };
            if state.method.hourglass {
                let both = stiffness + if differ { hourglass_stiffness(state, bond.b) * far } else { stiffness };
                others = others - displacement_difference::<S, B>(state, a, &bond) * (both * bond.row.weight);
            }
        }
    }
    if state.method.gradient == Gradient::Quadratic {
        others += quadratic_part::<S, B>(state, a);
    }
    (S::mat_vec(columns.bond_stress[a], own) + others) * (S::Real::of(1.0) / body.density)
}

fn quadratic_part<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> S::Vec {
    let stress = &state.columns.quadratic_stress;
    let mut sum = S::Vec::default();
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            let products = S::products(bond.row.x) * (S::Real::of(-1.0) * bond.row.weight);
            sum += S::tri_sym(stress[a] - stress[bond.b] * far_weight::<S, B>(state, a, bond.b), products);
        }
    }
    sum
}
