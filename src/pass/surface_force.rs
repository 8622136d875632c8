//! Adds the acceleration by the facets that a particle carries, and finds the energy and the heat of their contact.
//! Twin: shaders/pass/surface_force.wgsl

use super::Stage;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut accelerations = std::mem::take(&mut state.columns.acceleration);
    let mut energies = std::mem::take(&mut state.columns.contact_energy);
    let mut heats = std::mem::take(&mut state.columns.dissipated_energy);
    let beside = state.method.contact.with_energy();
    super::write(&mut energies, |a, energy| {
        let touched = state.facets_of(a).filter(|&e| state.facet_touched(e));
        let own = touched.fold(S::Real::of(0.0), |sum, e| sum + state.columns.facet_energy[e]);
        *energy = if beside { *energy + own } else { own };
    });
    super::write(&mut accelerations, |a, acceleration| {
        let mut touched = state.facets_of(a).filter(|&e| state.facet_touched(e)).peekable();
        if touched.peek().is_some() {
            let force = touched.fold(S::Vec::default(), |sum, e| sum + state.columns.facet_force[e]);
            *acceleration += force * (S::Real::of(1.0) / state.mass(a));
        }
    });
    if state.method.friction && !heats.is_empty() {
        super::write(&mut heats, |a, heat| {
            let made = state.facets_of(a).fold(S::Real::of(0.0), |sum, e| sum + state.columns.facet_heat[e]);
            *heat += made / state.mass(a);
        });
    }
    state.columns.acceleration = accelerations;
    state.columns.contact_energy = energies;
    state.columns.dissipated_energy = heats;
}
