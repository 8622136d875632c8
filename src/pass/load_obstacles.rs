//! Sums the force on each rigid obstacle, and ends the kick of those that are free. Twin:
//! shaders/pass/load_obstacles.wgsl

use super::Stage;
use super::declaration::{Declaration, Domain, Entry, Runs, always};
use super::move_obstacles::half_kick;
use super::write::fill;
use crate::fields::REDUCTION_BLOCK;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "sums the force on each rigid obstacle",
        entries: &[Entry::new("blocks", Domain::FacetBlocks), Entry::new("total", Domain::One)],
        runs: Runs::Running,
        own: &[always(&[FacetLoad, FacetObstacle, ObstacleVelocity, ObstacleForce, BlockLoad])],
        neighbours: &[],
        writes: &[always(&[ObstacleVelocity, ObstacleForce, BlockLoad])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let (total, blocks) = (state.params.facet_count as usize, state.params.counts().facet_blocks());
    fill!(state, block_load, |place, slot| {
        let (k, block) = (place / blocks, place % blocks);
        let first = block * REDUCTION_BLOCK;
        *slot = (first..(first + REDUCTION_BLOCK).min(total))
            .filter(|&e| state.columns.facet_obstacle[e] as usize == k + 1)
            .fold(S::Vec::default(), |sum, e| sum - state.columns.facet_load[e]);
    });
    for k in 0..state.params.obstacle_count as usize {
        let parts = &state.columns.block_load[k * blocks..(k + 1) * blocks];
        state.columns.obstacle_force[k] = parts.iter().fold(S::Vec::default(), |sum, &part| sum + part);
        if state.movers[k].inverse_mass > S::Real::of(0.0) {
            let gained = half_kick(state, k);
            state.columns.obstacle_velocity[k] += gained;
        }
    }
}
