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
    // Facets of one particle follow each other: what they share is found once.
    let carrier = || Carrier::<S> { particle: usize::MAX, turn: S::Mat::default() };
    let rows = (&mut displacements, &mut normals).into_par_iter().enumerate().with_min_len(super::GRAIN);
    if state.method.friction {
        rows.zip(&mut moves).for_each_init(carrier, |carrier, ((e, (place, direction)), step)| {
            let before = *place;
            (*place, *direction) = seat(state, e, carrier);
            *step = *place - before;
        });
    } else {
        rows.for_each_init(carrier, |carrier, (e, (place, direction))| (*place, *direction) = seat(state, e, carrier));
    }
    state.particles.facet_displacement = displacements;
    state.particles.facet_move = moves;
    state.particles.facet_normal = normals;
    state.particles.facet_pressed.fill(0);
}

/// What turns the normals of a particle's facets, the cofactors of F.
struct Carrier<S: Space> {
    particle: usize,
    turn: S::Mat,
}

/// Displacement and normal of a facet.
#[inline(always)]
fn seat<S: Space>(state: &State<S>, e: usize, carrier: &mut Carrier<S>) -> (S::Vec, S::Vec) {
    let a = state.particles.facet_owner[e] as usize;
    let gradient = state.particles.displacement_gradient[a];
    if carrier.particle != a {
        *carrier = Carrier { particle: a, turn: S::transpose(S::adjugate(S::mat_identity() + gradient)) };
    }
    let displacement = state.particles.displacement[a] + S::mat_vec(gradient, lever(state, e));
    let normal = S::mat_vec(carrier.turn, state.particles.facet_reference_normal[e]);
    (displacement, normal * (S::Real::of(1.0) / S::inner(normal, normal).sqrt()))
}
