//! Moves facets with their particles: x = x_p + F_p (X - X_p), n = F_p^-T N/|F_p^-T N|. Twin:
//! shaders/pass/place_facets.wgsl

use super::Stage;
use super::declaration::{Declaration, FACETS, Runs, always, when};
use super::write::{GRAIN, Rows, with_columns, write_blocks};
use crate::facet::lever;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "moves facets with their particles",
        entries: FACETS,
        runs: Runs::Running,
        own: &[
            always(&[
                ReferencePosition,
                Displacement,
                DisplacementGradient,
                FacetOwner,
                FacetReferencePosition,
                FacetReferenceNormal,
            ]),
            when(|m| m.friction, &[FacetDisplacement]),
        ],
        neighbours: &[],
        writes: &[
            always(&[FacetDisplacement, FacetNormal]),
            when(|m| m.friction, &[FacetMove]),
            when(|m| m.gap.is_some(), &[FacetPressed]),
        ],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_columns!(state, [facet_displacement, facet_move, facet_normal] => {
        // Facets of one particle follow each other: what they share is found once.
        let carrier = || Carrier::<S> { particle: usize::MAX, turn: S::Mat::default() };
        let places = (&mut facet_displacement[..], &mut facet_normal[..]);
        if state.method.friction {
            write_blocks((places, &mut facet_move[..]), GRAIN, &|first, block| {
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
    });
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
