//! Moves facets with their particles: x = x_p + F_p (X - X_p), n = F_p^-T N/|F_p^-T N|. Twin:
//! shaders/pass/place_facets.wgsl

use super::Stage;
use crate::facet::lever;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut displacements = std::mem::take(&mut state.particles.facet_displacement);
    let mut moves = std::mem::take(&mut state.particles.facet_move);
    let mut normals = std::mem::take(&mut state.particles.facet_normal);
    super::write(&mut moves, |e, slot| *slot = displacement(state, e) - displacements[e]);
    super::write(&mut displacements, |e, slot| *slot = displacement(state, e));
    super::write(&mut normals, |e, slot| *slot = normal(state, e));
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
