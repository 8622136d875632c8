//! Adds the acceleration by the facets that a particle carries, and finds the energy and the heat of their contact.
//! Twin: shaders/pass/surface_force.wgsl

use super::Stage;
use super::declaration::{Declaration, PARTICLES, Runs, always, when};
use super::write::fill;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "adds the acceleration by the facets that a particle carries",
        entries: PARTICLES,
        runs: Runs::Running,
        own: &[
            always(&[ReferenceVolume, Acceleration, FirstFacet, Facets, FacetForce, FacetEnergy]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.gap.is_some(), &[FacetPressed]),
            when(|m| m.obstacles, &[FacetObstacle]),
            when(|m| m.friction && m.dissipated_energy, &[DissipatedEnergy, FacetHeat]),
            when(|m| m.contact.with_energy(), &[ContactEnergy]),
        ],
        neighbours: &[],
        writes: &[always(&[Acceleration, ContactEnergy]), when(|m| m.friction && m.dissipated_energy, &[DissipatedEnergy])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let beside = state.method.contact.with_energy();
    fill!(state, contact_energy, |a, energy| {
        let touched = state.facets_of(a).filter(|&e| state.facet_touched(e));
        let own = touched.fold(S::Real::of(0.0), |sum, e| sum + state.columns.facet_energy[e]);
        *energy = if beside { *energy + own } else { own };
    });
    fill!(state, acceleration, |a, acceleration| {
        let mut touched = state.facets_of(a).filter(|&e| state.facet_touched(e)).peekable();
        if touched.peek().is_some() {
            let force = touched.fold(S::Vec::default(), |sum, e| sum + state.columns.facet_force[e]);
            *acceleration += force * (S::Real::of(1.0) / state.mass(a));
        }
    });
    if state.method.friction {
        fill!(state, dissipated_energy, |a, heat| {
            let made = state.facets_of(a).fold(S::Real::of(0.0), |sum, e| sum + state.columns.facet_heat[e]);
            *heat += made / state.mass(a);
        });
    }
}
