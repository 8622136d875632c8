//! rho_a = sum m_b W_ab, the particle itself included, Fuller (2.22). Twin: shaders/pass/sum_density.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::pair::{blocks, pair_coupling};
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "density from the masses around, Fuller (2.22)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
        ],
        neighbours: &[always(&[ReferencePosition, ReferenceVolume, Displacement]), when(|m| m.many_bodies, &[Body])],
        writes: &[always(&[VolumetricStrain])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    fill!(state, volumetric_strain, |a, slot| {
        let body = state.body(a);
        let mut density = state.mass(a) * kernel.weight(S::Real::of(0.0), state.smoothing_length(a));
        for block in blocks(state, a) {
            for (pair, weight) in block.pairs().zip(block.weights(&kernel)) {
                let mass = state.mass(pair.b) * pair_coupling(state, a, pair.b);
                density += mass * weight;
            }
        }
        *slot = body.density / density - S::Real::of(1.0);
    });
}
