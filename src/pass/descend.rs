//! One step toward equilibrium: u += back v, then v = keep v + push a, then u += forward v, with a the out-of-balance
//! acceleration. The numbers come from [`super::bound_residual`]. Twin: shaders/pass/descend.wgsl

use super::write::{GRAIN, write_rows};
use super::{Stage, compensated_add, unbalanced};
use crate::state::State;
use crate::tensor::Space;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut displacement = std::mem::take(&mut state.columns.displacement);
    let mut velocity = std::mem::take(&mut state.columns.velocity);
    let mut carry = std::mem::take(&mut state.columns.displacement_carry);
    let advance = |a: usize, v: &mut S::Vec| {
        let before = *v;
        *v = before * state.balance.keep + unbalanced(state, a) * state.balance.push;
        before * state.balance.back + *v * state.balance.forward
    };
    if carry.is_empty() {
        write_rows((&mut displacement[..], &mut velocity[..]), GRAIN, |a, (u, v)| *u += advance(a, v));
    } else {
        for (a, (u, v)) in displacement.iter_mut().zip(&mut velocity).enumerate() {
            compensated_add::<S>(u, &mut carry[a], advance(a, v));
        }
    }
    state.columns.displacement = displacement;
    state.columns.velocity = velocity;
    state.columns.displacement_carry = carry;
}
