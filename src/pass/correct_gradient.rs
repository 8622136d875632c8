//! Inverse of K_a = sum V_b (x_b - x_a) (x) grad_a W_ab (Bonet & Lok 1999).
//! Twin: shaders/pass/correct_gradient.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::pair::{blocks, pair_coupling, safe_inverse};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "inverse of the first moment of the kernel gradient",
        entries: LISTED,
        runs: Runs::Running,
        own: &[always(&[ReferencePosition, Displacement, NeighborCount, Neighbors]), when(|m| m.many_bodies, &[Body])],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, VolumetricStrain]),
            when(|m| m.many_bodies, &[Body]),
        ],
        writes: &[always(&[Correction])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    fill!(state, correction, |a, slot| *slot = safe_inverse::<S>(moment(state, a)));
}

#[inline(always)]
fn moment<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let mut moment = S::Mat::default();
    for block in blocks(state, a) {
        for pair in block.pairs() {
            let weight = state.volume(pair.b) * pair_coupling(state, a, pair.b) * pair.gradient;
            moment = moment - S::outer(pair.x, pair.x * weight);
        }
    }
    moment
}
