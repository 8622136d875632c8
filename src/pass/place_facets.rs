//! Moves facets with their particles: x = x_p + F_p (X - X_p), n = F_p^-T N/|F_p^-T N|. Twin:
//! shaders/pass/place_facets.wgsl

use super::Stage;
use super::write::{GRAIN, Rows, write_blocks};
use crate::facet::lever;
use crate::state::State;
use crate::tensor::{Real, Space};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    if state.clock.running == 0 {
        return;
    }
    let mut displacements = std::mem::take(&mut state.columns.facet_displacement);
    let mut moves = std::mem::take(&mut state.columns.facet_move);
    let mut normals = std::mem::take(&mut state.columns.facet_normal);
    // Facets of one particle follow each other: what they share is found once.
    let carrier = || Carrier::<S> { particle: usize::MAX, turn: S::Mat::default() };
    let places = (&mut displacements[..], &mut normals[..]);
    if state.method.friction {
        write_blocks((places, &mut moves[..]), GRAIN, &|first, block| {
            let mut carrier = carrier();
            for (e, ((place, direction), step)) in (first..).zip(block.rows()) {
                let before = *place;
                (*place, *direction) = seat(state, e, &mut carrier);
                *step = *place - before;
            }
        });
    } else {
        write_blocks(places, GRAIN, &|first, block| {
            let mut carrier = carrier();
            for (e, (place, direction)) in (first..).zip(block.rows()) {
                (*place, *direction) = seat(state, e, &mut carrier);
            }
        });
    }
    state.columns.facet_displacement = displacements;
    state.columns.facet_move = moves;
    state.columns.facet_normal = normals;
    state.columns.facet_pressed.fill(0);
}

/// What turns the normals of a particle's facets, the cofactors of F.
struct Carrier<S: Space> {
    particle: usize,
    turn: S::Mat,
}

/// Displacement and normal of a facet.
#[inline(always)]
fn seat<S: Space>(state: &State<S>, e: usize, carrier: &mut Carrier<S>) -> (S::Vec, S::Vec) {
    let a = state.columns.facet_owner[e] as usize;
    let gradient = state.columns.displacement_gradient[a];
    if carrier.particle != a {
        *carrier = Carrier { particle: a, turn: S::transpose(S::adjugate(S::mat_identity() + gradient)) };
    }
    let displacement = state.columns.displacement[a] + S::mat_vec(gradient, lever(state, e));
    let normal = S::mat_vec(carrier.turn, state.columns.facet_reference_normal[e]);
    (displacement, normal * (S::Real::of(1.0) / S::inner(normal, normal).sqrt()))
}
