//! Inverse of K_a = sum V_b (x_b - x_a) (x) grad_a W_ab (Bonet & Lok 1999).
//! Twin: shaders/pass/correct_gradient.wgsl

use super::Stage;
use crate::pair::{blocks, pair_coupling, safe_inverse};
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut corrections = std::mem::take(&mut state.columns.correction);
    super::write(&mut corrections, |a, slot| *slot = safe_inverse::<S>(moment(state, a)));
    state.columns.correction = corrections;
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
