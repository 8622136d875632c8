//! One step toward equilibrium: u += back v, then v = keep v + push a, then u += forward v, with a the out-of-balance
//! acceleration. The numbers come from [`super::bound_residual`]. Twin: shaders/pass/descend.wgsl

use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::{GRAIN, with_columns, write_rows};
use super::{Stage, compensated_add, unbalanced};
use crate::state::State;
use crate::tensor::Space;

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "moves free particles toward equilibrium",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[Displacement, Velocity, Acceleration]),
            when(|m| m.constraints, &[Constraint]),
            when(|m| m.compensated, &[DisplacementCarry]),
        ],
        neighbours: &[],
        writes: &[always(&[Displacement, Velocity]), when(|m| m.compensated, &[DisplacementCarry])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_columns!(state, [displacement, velocity, displacement_carry] => {
        let advance = |a: usize, v: &mut S::Vec| {
            let before = *v;
            *v = before * state.balance.keep + unbalanced(state, a) * state.balance.push;
            before * state.balance.back + *v * state.balance.forward
        };
        if displacement_carry.is_empty() {
            write_rows((&mut displacement[..], &mut velocity[..]), GRAIN, |a, (u, v)| *u += advance(a, v));
        } else {
            for (a, (u, v)) in displacement.iter_mut().zip(&mut velocity).enumerate() {
                compensated_add::<S>(u, &mut displacement_carry[a], advance(a, v));
            }
        }
    });
}
