//! Force of other bodies' surfaces on each facet, as the facet that measures a gap and as one that another measures
//! from, and the derivative of the energy by the deformation gradient of the facet's particle. See [`crate::facet`].
//! Twin: shaders/pass/press_facets.wgsl
//!
//! Friction pulls the other surface where the facet is, so that the two forces meet in one point.

use super::Stage;
use super::declaration::{Declaration, FACETS, Runs, always, when};
use super::write::{GRAIN, with_columns, write_rows};
use crate::facet::{Facing, facing, lever};
use crate::method::GapForm;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "force of other bodies' surfaces on each facet",
        entries: FACETS,
        runs: Runs::Running,
        own: &[
            always(&[
                ReferencePosition,
                DisplacementGradient,
                FacetOwner,
                FacetReferencePosition,
                FacetDisplacement,
                FacetNormal,
                FacetContactCount,
                FacetPressed,
                FacetPull,
                FacetContacts,
            ]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| !m.along_normals(), &[FacetGap, FacetEdge]),
            when(|m| m.friction, &[FacetTraction]),
        ],
        neighbours: &[
            always(&[FacetOwner, FacetReferencePosition, FacetDisplacement, FacetNormal, FacetPull]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| !m.along_normals(), &[FacetGap, FacetEdge]),
            when(|m| m.friction, &[FacetSpread, FacetTraction]),
        ],
        writes: &[always(&[FacetForce, FacetMoment])],
    }
};

/// What acts on a facet.
#[derive(Clone, Copy, Default)]
struct Load<V, M> {
    force: V,
    /// Minus the derivative of the energy by the facet's present normal.
    turning: V,
    /// Derivative of the energy by F, from friction that acts at a point other than the facet's.
    aside: M,
}

type LoadIn<S> = Load<<S as Space>::Vec, <S as Space>::Mat>;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_columns!(state, [facet_force, facet_moment] => {
        write_rows((&mut facet_force[..], &mut facet_moment[..]), GRAIN, |e, (force, moment)| {
            (*force, *moment) = if state.columns.facet_pressed[e] > 0 { load(state, e) } else { Default::default() };
        });
    });
}

fn load<S: Space>(state: &State<S>, e: usize) -> (S::Vec, S::Mat) {
    let a = state.columns.facet_owner[e] as usize;
    let deformation = S::mat_identity() + state.columns.displacement_gradient[a];
    let inverse = S::adjugate(deformation) * (S::Real::of(1.0) / S::determinant(deformation));
    let load = sum(state, e, inverse);
    let normal = state.columns.facet_normal[e];
    let turning = load.turning - normal * S::inner(load.turning, normal);
    let moment = S::outer(normal, S::mat_vec(inverse, turning)) - S::outer(load.force, lever(state, e));
    (load.force, moment + load.aside)
}

fn sum<S: Space>(state: &State<S>, e: usize, inverse: S::Mat) -> LoadIn<S> {
    let columns = &state.columns;
    let (total, zero) = (state.params.facet_count as usize, S::Real::of(0.0));
    let a = columns.facet_owner[e] as usize;
    let mut load = LoadIn::<S>::default();
    if state.method.friction {
        load.force += columns.facet_traction[e];
    }
    for k in 0..columns.facet_contact_count[e] as usize {
        let f = state.columns.facet_contacts[k * total + e] as usize;
        if columns.facet_pull[e] == zero && columns.facet_pull[f] == zero {
            continue;
        }
        let pair = state.listed_pair(a, f);
        let facing = facing(state, e, f, pair.range);
        press(state, (e, f), &facing, &mut load);
        if state.method.friction {
            let pulled = columns.facet_traction[f] * (zero - facing.weight * columns.facet_spread[f]);
            load.force += pulled;
            // From facet e to facet f, where the force acts.
            let way = S::mat_vec(inverse, facing.x);
            load.aside += S::outer(pulled, way);
        }
    }
    load
}

/// Adds the force of facet f on e.
#[inline(always)]
fn press<S: Space>(state: &State<S>, (e, f): (usize, usize), facing: &Facing<S>, load: &mut LoadIn<S>) {
    let columns = &state.columns;
    let (own, other) = (columns.facet_normal[e], columns.facet_normal[f]);
    let (pull, pulled) = (columns.facet_pull[e], columns.facet_pull[f]);
    let x = facing.x;
    // The force is minus the derivatives of the energy by the distances along the two normals.
    load.force += own * (pulled * facing.weight) - other * (pull * facing.weight);
    if state.method.gap == Some(GapForm::AlongNormals) {
        return;
    }
    let along = S::inner(other, x) - columns.facet_gap[e];
    let along_other = S::Real::of(0.0) - S::inner(own, x) - columns.facet_gap[f];
    let by_weight = pull * along + columns.facet_edge[e] + pulled * along_other + columns.facet_edge[f];
    load.force += x * (S::Real::of(0.0) - by_weight * facing.by_distance);
    load.turning += x * (pulled * facing.weight) - other * (by_weight * facing.by_turn);
}
