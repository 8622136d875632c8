//! Normals of surface particles, Fuller (4.1): sum W_ab (x_a - x_b)/r_ab made a unit vector, over all neighbours of the
//! same body or over those inside alone; zero where nothing is left to sum. See [`crate::contact::zones`].
//! Twin: shaders/pass/find_normals.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::find_surface::own_neighbors;
use super::write::fill;
use crate::contact::zones::Normals;
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "normals of surface particles, Fuller (4.1)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[always(&[ReferencePosition, Displacement, Surface, NeighborCount, Neighbors]), when(|m| m.many_bodies, &[Body])],
        neighbours: &[always(&[ReferencePosition, Displacement, Surface]), when(|m| m.many_bodies, &[Body])],
        writes: &[always(&[SurfaceNormal])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, stage: Stage) {
    fill!(state, surface_normal, |a, slot| *slot = normal(state, a, stage));
}

fn normal<S: Space>(state: &State<S>, a: usize, stage: Stage) -> S::Vec {
    let surface = &state.columns.surface;
    if surface[a] == 0 {
        return S::Vec::default();
    }
    let all = state.method.contact.zones.is_some_and(|zones| zones.normals == Normals::All);
    let (kernel, h) = (Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION), state.smoothing_length(a));
    let (mut sum, mut total) = (S::Vec::default(), S::Real::of(0.0));
    for (_, x) in own_neighbors(state, a, stage.reference).filter(|&(b, _)| all || surface[b] == 0) {
        let distance = S::inner(x, x).sqrt();
        let weight = kernel.weight(distance, h);
        sum += x * (weight / distance.max(S::Real::of(1e-6) * h));
        total += weight;
    }
    let length = S::inner(sum, sum).sqrt();
    // Where neighbours on all sides cancel there is no normal, only rounding.
    if length > S::Real::of(1e-4) * total { sum * (S::Real::of(1.0) / length) } else { S::Vec::default() }
}
