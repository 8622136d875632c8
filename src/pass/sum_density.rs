//! rho_a = sum m_b W_ab, the particle itself included, Fuller (2.22). Twin: shaders/pass/sum_density.wgsl

use super::Stage;
use crate::pair::{blocks, pair_coupling};
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    sum(state);
}

fn sum<S: Space>(state: &mut State<S>) {
    if state.clock.running == 0 {
        return;
    }
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let mut strain = std::mem::take(&mut state.columns.volumetric_strain);
    super::write(&mut strain, |a, slot| {
        let body = state.body(a);
        let mut density = state.mass(a) * kernel.weight(S::Real::of(0.0), body.smoothing_length);
        for block in blocks(state, a) {
            for (pair, weight) in block.pairs().zip(block.weights(&kernel)) {
                let mass = state.mass(pair.b) * pair_coupling(state, a, pair.b);
                density += mass * weight;
            }
        }
        *slot = body.density / density - S::Real::of(1.0);
    });
    state.columns.volumetric_strain = strain;
}
