//! By how much the colour of the bodies that a particle touches exceeds the threshold, <sum V_b W_ab - c0>: see
//! [`crate::contact::colour_field`]. Twin: shaders/pass/sum_colour.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::contact::COLOUR_FIELD;
use crate::pair::separation;
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "how far the colour of the bodies touched exceeds its threshold",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[always(&[ReferencePosition, Displacement, ContactCount, Contacts]), when(|m| m.many_bodies, &[Body])],
        neighbours: &[always(&[ReferencePosition, ReferenceVolume, Displacement]), when(|m| m.many_bodies, &[Body])],
        writes: &[always(&[ColourExcess])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    fill!(state, colour_excess, |a, slot| *slot = sum(state, a));
}

fn sum<S: Space>(state: &State<S>, a: usize) -> S::Real {
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let (mut colour, mut threshold) = (S::Real::of(0.0), S::Real::of(0.0));
    for b in state.contacts_of(a) {
        let pair = state.contact_pair(a, b);
        if pair.law == COLOUR_FIELD {
            let x = separation(state, a, b as u32);
            threshold = pair.threshold;
            colour += state.columns.reference_volume[b] * kernel.weight(S::inner(x, x).sqrt(), S::Real::of(0.5) * pair.range);
        }
    }
    (colour - threshold).max(S::Real::of(0.0))
}
