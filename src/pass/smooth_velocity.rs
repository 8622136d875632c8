//! Velocity averaged over neighbours, Fuller (3.2): v_a + weight sum (m_b/rho_ab)(v_b - v_a) W_ab.
//! Monaghan's XSPH moves the positions with it; [`super::filter_velocity`] puts it in the velocity's place.
//! Twin: shaders/pass/smooth_velocity.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::pair::{blocks, pair_coupling, velocity_difference};
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "velocity averaged over neighbours, Fuller (3.2)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, Displacement, Velocity, VolumetricStrain, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, Velocity, VolumetricStrain]),
            when(|m| m.many_bodies, &[Body]),
        ],
        writes: &[always(&[SmoothedVelocity])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    fill!(state, smoothed_velocity, |a, slot| *slot = smooth(state, a));
}

#[inline(always)]
fn smooth<S: Space>(state: &State<S>, a: usize) -> S::Vec {
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let mut sum = S::Vec::default();
    for block in blocks(state, a) {
        for (pair, weight) in block.pairs().zip(block.weights(&kernel)) {
            let density = S::Real::of(0.5) * (state.density(a) + state.density(pair.b));
            let mass = state.mass(pair.b) * pair_coupling(state, a, pair.b);
            sum += velocity_difference(state, a, &pair) * (mass / density * weight);
        }
    }
    state.columns.velocity[a] + sum * state.params.smoothing_weight
}
