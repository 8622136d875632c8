//! Velocity gradient L_a. Twin: shaders/pass/strain_rate.wgsl
//!
//! Plain: L_a = (1/rho_a) sum m_b (v_b - v_a) (x) grad_a W_ab. Fuller (2.14) has m_b/rho_b inside the sum; with
//! the density outside, the trace is exactly his continuity equation (2.21) and the stress power is exactly
//! the work of his force (2.59).
//!
//! Corrected: weights V_b, and the sum is multiplied by the inverse of sum V_b (x_b - x_a) (x) grad_a W_ab,
//! which makes it exact for linear velocity fields (Bonet & Lok 1999).

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::write::fill;
use crate::method::Gradient;
use crate::pair::{blocks, pair_coupling, safe_inverse, velocity_difference};
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "velocity gradient, Fuller (2.14)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, Displacement, Velocity, NeighborCount, Neighbors]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| !m.corrects_rate(), &[VolumetricStrain]),
        ],
        neighbours: &[
            always(&[ReferencePosition, ReferenceVolume, Displacement, Velocity]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.corrects_rate(), &[VolumetricStrain]),
        ],
        writes: &[always(&[VelocityGradient])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.method.gradient == Gradient::Plain {
        fill!(state, velocity_gradient, |a, slot| *slot = plain_gradient(state, a));
    } else {
        fill!(state, velocity_gradient, |a, slot| *slot = corrected_gradient(state, a));
    }
}

#[inline(always)]
fn plain_gradient<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let mut sum = S::Mat::default();
    for block in blocks(state, a) {
        for pair in block.pairs() {
            let weight = state.mass(pair.b) * pair_coupling(state, a, pair.b) * pair.gradient;
            sum += S::outer(velocity_difference(state, a, &pair), pair.x * weight);
        }
    }
    sum * (S::Real::of(1.0) / state.density(a))
}

#[inline(always)]
fn corrected_gradient<S: Space>(state: &State<S>, a: usize) -> S::Mat {
    let (mut sum, mut moment) = (S::Mat::default(), S::Mat::default());
    for block in blocks(state, a) {
        for pair in block.pairs() {
            let weight = state.volume(pair.b) * pair_coupling(state, a, pair.b) * pair.gradient;
            let gradient = pair.x * weight;
            sum += S::outer(velocity_difference(state, a, &pair), gradient);
            moment = moment - S::outer(pair.x, gradient);
        }
    }
    S::mat_mat(sum, safe_inverse::<S>(moment))
}
