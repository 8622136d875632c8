//! Moves facets with their particles: x = x_p + F_p (X - X_p), n = F_p^-T N/|F_p^-T N|. Twin:
//! shaders/pass/place_facets.wgsl

use super::Stage;
use crate::facet::lever;
use crate::state::State;
use crate::tensor::{Real, Space};
use rayon::prelude::*;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut displacements = std::mem::take(&mut state.particles.facet_displacement);
    let mut moves = std::mem::take(&mut state.particles.facet_move);
    let mut normals = std::mem::take(&mut state.particles.facet_normal);
    let rows = (&mut displacements, &mut moves, &mut normals).into_par_iter().enumerate();
    rows.with_min_len(super::GRAIN).for_each(|(e, (place, step, direction))| {
        let moved = displacement(state, e);
        *step = moved - *place;
        *place = moved;
        *direction = normal(state, e);
    });
    state.particles.facet_displacement = displacements;
    state.particles.facet_move = moves;
    state.particles.facet_normal = normals;
}

fn displacement<S: Space>(state: &State<S>, e: usize) -> S::Vec {
    let a = state.particles.facet_owner[e] as usize;
    state.particles.displacement[a] + S::mat_vec(state.particles.displacement_gradient[a], lever(state, e))
}

fn normal<S: Space>(state: &State<S>, e: usize) -> S::Vec {
    let a = state.particles.facet_owner[e] as usize;
    let cofactor = S::transpose(S::adjugate(S::mat_identity() + state.particles.displacement_gradient[a]));
    let normal = S::mat_vec(cofactor, state.particles.facet_reference_normal[e]);
    normal * (S::Real::of(1.0) / S::inner(normal, normal).sqrt())
}
