//! Sums the force on each rigid obstacle, and ends the kick of those that are free. Twin:
//! shaders/pass/load_obstacles.wgsl

use super::Stage;
use super::move_obstacles::half_kick;
use crate::fields::REDUCTION_BLOCK;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let (total, blocks) = (state.params.facet_count as usize, state.params.counts().facet_blocks());
    let mut sums = std::mem::take(&mut state.columns.block_load);
    super::write(&mut sums, |place, slot| {
        let (k, block) = (place / blocks, place % blocks);
        let first = block * REDUCTION_BLOCK;
        *slot = (first..(first + REDUCTION_BLOCK).min(total))
            .filter(|&e| state.columns.facet_obstacle[e] as usize == k + 1)
            .fold(S::Vec::default(), |sum, e| sum - state.columns.facet_load[e]);
    });
    for k in 0..state.params.obstacle_count as usize {
        let force = sums[k * blocks..(k + 1) * blocks].iter().fold(S::Vec::default(), |sum, &part| sum + part);
        state.columns.obstacle_force[k] = force;
        if state.movers[k].inverse_mass > S::Real::of(0.0) {
            let gained = half_kick(state, k);
            state.columns.obstacle_velocity[k] += gained;
        }
    }
    state.columns.block_load = sums;
}
