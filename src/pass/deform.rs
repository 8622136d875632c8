//! H_a = [sum V_b (u_b - u_a) (x) grad_a W_ab] K_a^-1, the stress P_a of the material, and what the bonds carry of
//! it, P_a K_a^-1 - alpha E H_a. Twin: shaders/pass/deform.wgsl
//!
//! The sums run over the reference configuration. The second term is the part of the hourglass force that
//! belongs to one particle; see [`super::bond_force`]. In between, a law that remembers takes its memory to the
//! end of the step.
//!
//! With the quadratic-exact gradient H = [sum ..] C1 + [sum -V_b (W'/R) (u_b - u_a) (x) X_ab X_ab] C2, see
//! [`super::correct_quadratic`]; the hourglass term keeps the linear H, whose fit its energy belongs to.

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::{GRAIN, fill, with_columns, write_rows};
use crate::bond::{Source, displacement_difference, hourglass_stiffness, with_bonds};
use crate::material::{self, Memory};
use crate::method::Gradient;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "deformation gradient, stress, and what the bonds carry of it",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, Displacement, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.corrects_rate(), &[ReferenceCorrection]),
            when(
                |m| m.memory() && m.plastic() && m.quasi_static.is_some(),
                &[EquilibriumInelasticStrain, EquilibriumPlasticStrain],
            ),
            when(|m| m.quadratic_gradient(), &[LinearCoefficient, QuadraticCoefficient]),
            when(|m| m.memory(), &[InelasticStrain]),
            when(|m| m.memory() && m.plastic() && m.quasi_static.is_none(), &[EquivalentPlasticStrain]),
            when(|m| m.memory() && m.heated(), &[Temperature]),
            when(|m| m.memory() && m.dissipated_energy, &[DisplacementGradient, DissipatedEnergy]),
        ],
        neighbours: &[always(&[ReferencePosition, ReferenceVolume, Displacement]), when(|m| m.tied, &[Body])],
        writes: &[
            always(&[DisplacementGradient, BondStress]),
            when(|m| m.memory(), &[InelasticStrain]),
            when(|m| m.memory() && m.plastic(), &[EquivalentPlasticStrain]),
            when(|m| m.memory() && m.heated(), &[Temperature]),
            when(|m| m.memory() && m.dissipated_energy, &[DissipatedEnergy]),
            when(|m| m.quadratic_gradient(), &[QuadraticStress]),
        ],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    // Where nothing else comes between deformation and stress, one loop does both.
    let at_once = !state.method.memory() && state.method.gradient != Gradient::Quadratic;
    let heats = state.method.memory() && state.method.dissipated_energy;
    let before = if heats { state.columns.displacement_gradient.clone() } else { Vec::new() };
    with_columns!(state, [displacement_gradient, bond_stress] => with_bonds!(state, B => {
        write_rows((&mut displacement_gradient[..], &mut bond_stress[..]), GRAIN, |a, (gradient, stress)| {
            *stress = sum_bonds::<S, B>(state, a);
            *gradient = corrected(state, a, stress);
            let linear = *gradient;
            if state.method.gradient == Gradient::Quadratic {
                *gradient = quadratic_gradient::<S, B>(state, a, stress);
            }
            *stress = linear;
            if at_once {
                *stress = corrected(state, a, &piola(state, a, *gradient)) - linear * hourglass_stiffness(state, a);
            }
        });
    }));
    if at_once {
        return;
    }
    relax(state, &before);
    fill!(state, bond_stress, |a, slot| *slot = bond_stress(state, a) - *slot * hourglass_stiffness(state, a));
    fill!(state, quadratic_stress, |a, slot| {
        *slot = S::mat_tri(stress(state, a), state.columns.quadratic_coefficient[a]);
    });
}

/// Takes what the laws remember to the end of the step, at the new H. Before the first step the clock's is 0.
fn relax<S: Space>(state: &mut State<S>, before: &[S::Mat]) {
    if !state.method.memory() {
        return;
    }
    let step = state.clock.step;
    let mut memories = vec![Memory::default(); state.params.count as usize];
    let gradients = &state.columns.displacement_gradient;
    super::write(&mut memories, |a, memory| {
        *memory = material::relax::<S>(state.body(a), gradients[a], remembered(state, a), step);
    });
    if !before.is_empty() {
        fill!(state, dissipated_energy, |a, heat| {
            let (body, old) = (state.body(a), state.columns.inelastic_strain[a]);
            let of_step =
                material::dissipated::<S>(body, (before[a], old), (state.columns.displacement_gradient[a], memories[a].strain));
            *heat += of_step * (S::Real::of(1.0) / body.density);
        });
    }
    let columns = &mut state.columns;
    for (a, memory) in memories.into_iter().enumerate() {
        columns.inelastic_strain[a] = memory.strain;
        if let Some(slot) = columns.equivalent_plastic_strain.get_mut(a) {
            *slot = memory.plastic;
        }
        if let Some(slot) = columns.temperature.get_mut(a) {
            *slot = memory.temperature;
        }
    }
}

/// What the law remembers from before the step. In a descent to equilibrium, which is no motion in time, every step
/// begins at the last equilibrium.
#[inline(always)]
fn remembered<S: Space>(state: &State<S>, a: usize) -> Memory<S> {
    let columns = &state.columns;
    let (strains, plastic) = if state.method.quasi_static.is_some() {
        (&columns.equilibrium_inelastic_strain, &columns.equilibrium_plastic_strain)
    } else {
        (&columns.inelastic_strain, &columns.equivalent_plastic_strain)
    };
    Memory {
        strain: strains[a],
        plastic: plastic.get(a).copied().unwrap_or_default(),
        temperature: columns.temperature.get(a).copied().unwrap_or_default(),
    }
}

/// sum V_b (u_b - u_a) (x) grad_a W_ab. Out of line, so that the loop over bonds has all registers to itself.
#[inline(never)]
pub(super) fn sum_bonds<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> S::Mat {
    let mut sum = S::Mat::default();
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            sum += S::outer(displacement_difference::<S, B>(state, a, &bond), bond.row.gradient);
        }
    }
    sum
}

/// H of the quadratic fit, from the sum over the separations and another over their products.
fn quadratic_gradient<S: Space, B: Source<S>>(state: &State<S>, a: usize, first: &S::Mat) -> S::Mat {
    let mut second = S::Tri::default();
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            let products = S::products(bond.row.x) * (S::Real::of(-1.0) * bond.row.weight);
            second += S::tri_outer(displacement_difference::<S, B>(state, a, &bond), products);
        }
    }
    let columns = &state.columns;
    let linear = S::mat_mat(*first, S::mat_of_sym(columns.linear_coefficient[a]));
    linear + S::tri_tri(second, columns.quadratic_coefficient[a])
}

/// M K_a^-1. Out of line, so that the sums of the loop over bonds stay in vector registers.
#[inline(never)]
pub(super) fn corrected<S: Space>(state: &State<S>, a: usize, m: &S::Mat) -> S::Mat {
    if state.method.gradient == Gradient::Plain {
        return *m;
    }
    S::mat_mat(*m, S::mat_of_sym(state.columns.reference_correction[a]))
}

/// P_a
#[inline(always)]
fn piola<S: Space>(state: &State<S>, a: usize, gradient: S::Mat) -> S::Mat {
    let memory = state.columns.inelastic_strain.get(a).copied().unwrap_or_default();
    material::first_piola::<S>(state.body(a), gradient, memory)
}

#[inline(always)]
fn stress<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    piola(state, a, state.columns.displacement_gradient[a])
}

/// P_a K_a^-1, or P_a C1
#[inline(always)]
fn bond_stress<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    if state.method.gradient == Gradient::Quadratic {
        return S::mat_mat(stress(state, a), S::mat_of_sym(state.columns.linear_coefficient[a]));
    }
    corrected(state, a, &stress(state, a))
}
