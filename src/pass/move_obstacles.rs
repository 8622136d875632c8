//! Moves rigid obstacles to the end of the step: along their course, or, where they are free, as their mass and the
//! force of the bodies ask for. They do not turn. Twin: shaders/pass/move_obstacles.wgsl
//!
//! A free obstacle's half kick comes first; the other half follows in [`super::load_obstacles`].

use super::Stage;
use super::declaration::{Declaration, Domain, Entry, Runs, always, when};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "moves rigid obstacles to the end of the step",
        entries: &[Entry::new("main", Domain::One)],
        runs: Runs::Running,
        own: &[always(&[ObstacleDisplacement, ObstacleVelocity, ObstacleForce])],
        neighbours: &[],
        writes: &[always(&[ObstacleDisplacement, ObstacleVelocity]), when(|m| m.friction, &[ObstacleMove])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let step = state.clock.step;
    for k in 0..state.params.obstacle_count as usize {
        let mover = state.movers[k];
        let columns = &state.columns;
        let before = columns.obstacle_displacement[k];
        let (velocity, after) = if mover.inverse_mass > S::Real::of(0.0) {
            let velocity = columns.obstacle_velocity[k] + half_kick(state, k);
            (velocity, before + velocity * step)
        } else {
            prescribed(state, k)
        };
        state.columns.obstacle_velocity[k] = velocity;
        state.columns.obstacle_displacement[k] = after;
        if state.method.friction {
            state.columns.obstacle_move[k] = after - before;
        }
    }
}

/// Half a step's change of a free obstacle's velocity.
pub(super) fn half_kick<S: Space>(state: &State<S>, k: usize) -> S::Vec {
    let params = &state.params;
    let body_force = S::vec_of_reals([params.body_force_x, params.body_force_y, params.body_force_z]);
    (state.columns.obstacle_force[k] * state.movers[k].inverse_mass + body_force) * (S::Real::of(0.5) * state.clock.step)
}

/// Velocity, and the displacement since time 0, at the end of the step; in a descent at the end of the load step.
fn prescribed<S: Space>(state: &State<S>, k: usize) -> (S::Vec, S::Vec) {
    let (clock, mover) = (&state.clock, &state.movers[k]);
    if mover.condition == 0 {
        return Default::default();
    }
    let condition = &state.constraints[mover.condition as usize - 1];
    let ahead = if state.method.quasi_static.is_some() { clock.duration } else { clock.elapsed + clock.step };
    let time = clock.start + ahead;
    let vector = S::vec_of_reals([condition.x, condition.y, condition.z]);
    let way = state.course_integral(condition, S::Real::of(0.0), time);
    (vector * state.course_factor(condition, time), vector * way)
}
