//! Energy of the hourglass term of one particle, V_a (alpha E/2) sum V_b w |H_a X_ab - u_ab|^2 with w = -W'(R)/R and
//! the linear H: see [`super::bond_force`]. Run only when asked for. Twin: shaders/pass/hourglass_energy.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::deform::{corrected, sum_bonds};
use super::write::fill;
use crate::bond::{Source, displacement_difference, hourglass_stiffness, with_bonds};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "energy of the hourglass term, when asked for",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.corrects_rate(), &[ReferenceCorrection]),
            when(|m| m.plastic() && m.quasi_static.is_some(), &[EquilibriumPlasticStrain]),
            when(|m| m.plastic() && m.quasi_static.is_none(), &[EquivalentPlasticStrain]),
        ],
        neighbours: &[always(&[ReferencePosition, ReferenceVolume, Displacement]), when(|m| m.tied, &[Body])],
        writes: &[always(&[HourglassEnergy])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_bonds!(state, B => fill!(state, hourglass_energy, |a, slot| *slot = energy::<S, B>(state, a)));
}

fn energy<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> S::Real {
    let gradient = corrected(state, a, &sum_bonds::<S, B>(state, a));
    let mut sum = S::Real::of(0.0);
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            let stray = displacement_difference::<S, B>(state, a, &bond) + S::mat_vec(gradient, bond.row.x);
            sum += S::inner(stray, stray) * (S::Real::of(-1.0) * bond.row.weight);
        }
    }
    S::Real::of(0.5) * hourglass_stiffness(state, a) * state.columns.reference_volume[a] * sum
}
