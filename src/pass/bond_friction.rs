//! Adds Monaghan's viscosity between the ends of the bonds of the reference configuration,
//!
//! a_a -= sum m_b Pi_ab (dW/dR) x_ab/r_ab, Pi_ab = (-alpha c mu + beta mu^2)/rho_0, mu = h v_ab . x_ab/(r_ab^2 + softening h^2)
//!
//! while the two approach: Fuller (2.59), (2.60) with the sign mended, the kernel's slope at the distance in the
//! reference configuration and the force along the present separation, so that angular momentum is kept.
//! Twin: shaders/pass/bond_friction.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use crate::bond::{Bond, Source, displacement_difference, with_bonds};
use crate::pair::{mirror_vector, pair_coupling};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "adds viscosity between the ends of bonds",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, Displacement, Velocity, Acceleration, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
        ],
        neighbours: &[always(&[ReferencePosition, ReferenceVolume, Displacement, Velocity]), when(|m| m.tied, &[Body])],
        writes: &[always(&[Acceleration]), when(|m| m.dissipated_power(), &[DissipatedPower])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let mut sums = vec![(S::Vec::default(), S::Real::of(0.0)); state.params.count as usize];
    with_bonds!(state, B => super::write(&mut sums, |a, slot| *slot = sum::<S, B>(state, a)));
    let columns = &mut state.columns;
    for (a, (acceleration, power)) in sums.into_iter().enumerate() {
        columns.acceleration[a] += acceleration;
        if state.method.dissipated_power() {
            columns.dissipated_power[a] = power;
        }
    }
}

/// Acceleration, and half of the power that the bonds turn into heat, per mass.
fn sum<S: Space, B: Source<S>>(state: &State<S>, a: usize) -> (S::Vec, S::Real) {
    let (mut acceleration, mut power) = (S::Vec::default(), S::Real::of(0.0));
    for part in B::parts(state, a) {
        let block = B::load(state, a, part.clone());
        for lane in 0..part.len() {
            let bond = B::bond(&block, lane);
            let v_ba = velocity_difference::<S, B>(state, a, &bond);
            let friction = friction::<S, B>(state, a, &bond, v_ba);
            acceleration += friction;
            power += S::Real::of(0.5) * S::inner(v_ba, friction);
        }
    }
    (acceleration, power)
}

#[inline(always)]
fn friction<S: Space, B: Source<S>>(state: &State<S>, a: usize, bond: &Bond<S>, v_ba: S::Vec) -> S::Vec {
    let params = &state.params;
    let h = state.smoothing_length(a);
    // x_a - x_b
    let x = bond.row.x - displacement_difference::<S, B>(state, a, bond);
    let square = S::inner(x, x);
    let mu = (h * S::Real::of(-1.0) * S::inner(v_ba, x) / (square + params.softening * h * h)).min(S::Real::of(0.0));
    let [alpha, beta, sound_speed, share] = if B::TIES && state.method.tied {
        of_ends(state, a, bond.b)
    } else {
        [state.alpha(a), state.beta(a), state.body(a).sound_speed, S::Real::of(1.0)]
    };
    let pi = (beta * mu - alpha * sound_speed) * mu * share;
    let reference = S::inner(bond.row.x, bond.row.x).sqrt();
    // The slope times V_b; within a body m_b over rho_0 is V_b.
    x * (S::Real::of(-1.0) * pi * bond.row.weight * reference / square.sqrt().max(S::Real::of(1e-6) * h))
}

/// v_b - v_a, the neighbour's velocity mirrored if it is an image.
/// alpha, beta and the speed of sound of a bond that may join two bodies: the means of its ends, so that both feel the same Pi
/// and momentum is kept; and what the row's weight is to be multiplied by, so that it holds m_b over the mean density, with
/// no weight of an end.
#[inline(always)]
fn of_ends<S: Space>(state: &State<S>, a: usize, b: usize) -> [S::Real; 4] {
    let half = S::Real::of(0.5);
    let (own, other) = (state.body(a), state.body(b));
    let share = other.density / (half * (own.density + other.density)) / pair_coupling(state, a, b);
    let mean = |one: S::Real, two: S::Real| half * (one + two);
    [mean(state.alpha(a), state.alpha(b)), mean(state.beta(a), state.beta(b)), mean(own.sound_speed, other.sound_speed), share]
}

#[inline(always)]
fn velocity_difference<S: Space, B: Source<S>>(state: &State<S>, a: usize, bond: &Bond<S>) -> S::Vec {
    let velocity = &state.columns.velocity;
    let mut v_b = velocity[bond.b];
    if B::IMAGES && bond.image != 0 {
        v_b = mirror_vector::<S>(&state.params, bond.image, v_b);
    }
    v_b - velocity[a]
}
