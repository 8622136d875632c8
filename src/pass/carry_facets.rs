//! Adds to what the bonds carry the stress that the levers of a particle's facets make: (sum dU/dF)/V K^-1, so that
//! the forces on the bonds are the derivative of the energy of contact too. Twin: shaders/pass/carry_facets.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::deform::corrected;
use super::write::fill;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "adds to what the bonds carry the stress that the facets' levers make",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[ReferenceVolume, BondStress, FirstFacet, Facets, FacetMoment]),
            when(|m| m.gap.is_some(), &[FacetPressed]),
            when(|m| m.obstacles, &[FacetObstacle]),
            when(|m| m.corrects_rate(), &[ReferenceCorrection]),
        ],
        neighbours: &[],
        writes: &[always(&[BondStress])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    fill!(state, bond_stress, |a, stress| {
        let mut touched = state.facets_of(a).filter(|&e| state.facet_touched(e)).peekable();
        if touched.peek().is_some() {
            let sum = touched.fold(S::Mat::default(), |sum, e| sum + state.columns.facet_moment[e]);
            let mean = sum * (S::Real::of(1.0) / state.columns.reference_volume[a]);
            *stress += corrected(state, a, &mean);
        }
    });
}
