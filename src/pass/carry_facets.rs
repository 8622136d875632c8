//! Adds to what the bonds carry the stress that the levers of a particle's facets make: (sum dU/dF)/V K^-1, so that
//! the forces on the bonds are the derivative of the energy of contact too. Twin: shaders/pass/carry_facets.wgsl

use super::Stage;
use super::deform::corrected;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut stresses = std::mem::take(&mut state.columns.bond_stress);
    super::write(&mut stresses, |a, stress| {
        let mut touched = state.facets_of(a).filter(|&e| state.facet_touched(e)).peekable();
        if touched.peek().is_some() {
            let sum = touched.fold(S::Mat::default(), |sum, e| sum + state.columns.facet_moment[e]);
            let mean = sum * (S::Real::of(1.0) / state.columns.reference_volume[a]);
            *stress += corrected(state, a, &mean);
        }
    });
    state.columns.bond_stress = stresses;
}
