//! Distance of each facet from the surface that faces it, and what follows from it: the derivatives of its energy,
//! and friction. See [`crate::facet`]. A facet that presses on the other surface marks itself and the facets in its list as
//! pressed; the passes that follow skip all others, whose forces are zero. Twin: shaders/pass/measure_gap.wgsl

use super::Stage;
use super::declaration::{Declaration, FACETS, Runs, always, when};
use super::write::{GRAIN, with_columns, write_rows};
use crate::facet::{facing, fade, stick};
use crate::rows::FacetPair;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "smoothed distance of each facet from the surface that faces it, and friction",
        entries: FACETS,
        runs: Runs::Running,
        own: &[
            always(&[
                FacetOwner,
                FacetReferencePosition,
                FacetArea,
                FacetDisplacement,
                FacetNormal,
                FacetContactCount,
                FacetContacts,
            ]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.friction, &[FacetMove, FacetSlip]),
        ],
        neighbours: &[
            always(&[FacetOwner, FacetReferencePosition, FacetDisplacement, FacetNormal]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.friction, &[FacetMove]),
        ],
        writes: &[
            always(&[FacetPressed, FacetGap, FacetSpread, FacetPull, FacetEdge, FacetPressure, FacetEnergy]),
            when(|m| m.friction, &[FacetSlip, FacetTraction, FacetHeat]),
        ],
    }
};

/// What the pass finds for one facet.
#[derive(Clone, Copy, Default)]
struct Contact<R, V> {
    gap: R,
    spread: R,
    pull: R,
    edge: R,
    pressure: R,
    energy: R,
    slip: V,
    traction: V,
    heat: R,
}

type ContactIn<S> = Contact<<S as Space>::Real, <S as Space>::Vec>;

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    with_columns!(state, [facet_gap, facet_spread, facet_pull, facet_edge, facet_pressure, facet_energy] => {
        let measured = ((&mut facet_gap[..], &mut facet_spread[..]), (&mut facet_pull[..], &mut facet_edge[..]));
        let rows = (measured, (&mut facet_pressure[..], &mut facet_energy[..]));
        if state.method.friction {
            // The slip before is read while the new one is written.
            let mut slip = state.columns.facet_slip.clone();
            with_columns!(state, [facet_traction, facet_heat] => {
                let rubbed = (&mut slip[..], (&mut facet_traction[..], &mut facet_heat[..]));
                write_rows((rows, rubbed), GRAIN, |e, (row, (slip, (traction, heat)))| {
                    let contact = found(state, e);
                    (*slip, *traction, *heat) = (contact.slip, contact.traction, contact.heat);
                    contact.put(row);
                });
            });
            state.columns.facet_slip = slip;
        } else {
            write_rows(rows, GRAIN, |e, row| found(state, e).put(row));
        }
    });
    tell(state);
}

#[inline(always)]
fn found<S: Space>(state: &State<S>, e: usize) -> ContactIn<S> {
    if state.columns.facet_contact_count[e] > 0 { measure(state, e) } else { Contact::default() }
}

/// Marks each facet that presses, and every facet in its list. Some of the marked ones are only near and feel nothing; to
/// mark them too costs less than to sort them out.
fn tell<S: Space>(state: &mut State<S>) {
    let total = state.params.facet_count as usize;
    let columns = &mut state.columns;
    for (e, _) in columns.facet_pull.iter().enumerate().filter(|(_, pull)| **pull != S::Real::of(0.0)) {
        columns.facet_pressed[e] = 1;
        for k in 0..columns.facet_contact_count[e] as usize {
            let f = columns.facet_contacts[k * total + e] as usize;
            columns.facet_pressed[f] = 1;
        }
    }
}

/// One row of the columns that the pass writes with or without friction: gap, spread, pull, edge, pressure and energy.
type Measured<'c, R> = (((&'c mut R, &'c mut R), (&'c mut R, &'c mut R)), (&'c mut R, &'c mut R));

impl<R: Copy, V> Contact<R, V> {
    fn put(&self, (((gap, spread), (pull, edge)), (pressure, energy)): Measured<'_, R>) {
        (*gap, *spread, *pull) = (self.gap, self.spread, self.pull);
        (*edge, *pressure, *energy) = (self.edge, self.pressure, self.energy);
    }
}

/// The sums over the other surface: of weights, and of weights times distances, moves and normals; and the numbers of
/// the last pair in the list, which stand for the whole surface.
struct Sums<S: Space> {
    weight: S::Real,
    distance: S::Real,
    moved: S::Vec,
    normal: S::Vec,
    pair: FacetPair<S::Real>,
}

fn measure<S: Space>(state: &State<S>, e: usize) -> ContactIn<S> {
    let sums = sum(state, e);
    let (zero, one) = (S::Real::of(0.0), S::Real::of(1.0));
    let pair = sums.pair;
    let stiffness = pair.stiffness * state.columns.facet_area[e];
    let spread = if sums.weight > zero { one / sums.weight } else { zero };
    let gap = sums.distance * spread;
    if gap >= zero {
        return Contact { gap, heat: let_go(state, e, stiffness), ..Contact::default() };
    }
    let (whole, slope) = fade(sums.weight / pair.full);
    let half = S::Real::of(0.5) * stiffness * gap * gap;
    let force = zero - stiffness * gap * whole;
    let mut contact = Contact {
        gap,
        spread,
        pull: zero - force * spread,
        edge: half * slope / pair.full,
        pressure: force / state.columns.facet_area[e],
        energy: half * whole,
        ..Contact::default()
    };
    if state.method.friction && pair.friction > zero {
        rub(state, e, &sums, stiffness, force, &mut contact);
    }
    contact
}

/// Heat of a facet that has lost touch: the energy that its tangential spring still held.
fn let_go<S: Space>(state: &State<S>, e: usize, stiffness: S::Real) -> S::Real {
    let slip = state.columns.facet_slip.get(e).copied().unwrap_or_default();
    S::Real::of(0.5) * stiffness * S::inner(slip, slip)
}

/// The tangential spring, which stretches by the distance that the facet slips over the other surface.
fn rub<S: Space>(state: &State<S>, e: usize, sums: &Sums<S>, stiffness: S::Real, force: S::Real, contact: &mut ContactIn<S>) {
    let columns = &state.columns;
    let length = S::inner(sums.normal, sums.normal).sqrt();
    let normal = sums.normal * (S::Real::of(1.0) / length);
    let grown = columns.facet_slip[e] + columns.facet_move[e] - sums.moved * contact.spread;
    let along = grown - normal * S::inner(grown, normal);
    let (slip, heat) = stick::<S>(columns.facet_slip[e], along, stiffness, sums.pair.friction * force);
    contact.slip = slip;
    contact.heat = heat;
    contact.traction = slip * (S::Real::of(0.0) - stiffness);
    contact.energy += S::Real::of(0.5) * stiffness * S::inner(slip, slip);
}

#[inline(always)]
fn sum<S: Space>(state: &State<S>, e: usize) -> Sums<S> {
    let columns = &state.columns;
    let (total, zero) = (state.params.facet_count as usize, S::Real::of(0.0));
    let a = columns.facet_owner[e] as usize;
    let (moved, normal) = (S::Vec::default(), S::Vec::default());
    let mut sums = Sums::<S> { weight: zero, distance: zero, moved, normal, pair: FacetPair::default() };
    for k in 0..columns.facet_contact_count[e] as usize {
        let f = state.columns.facet_contacts[k * total + e] as usize;
        let pair = state.listed_pair(a, f);
        sums.pair = *pair;
        let facing = facing(state, e, f, pair.range);
        sums.weight += facing.weight;
        sums.distance += facing.weight * S::inner(columns.facet_normal[f], facing.x);
        if state.method.friction {
            sums.moved += columns.facet_move[f] * facing.weight;
            sums.normal += columns.facet_normal[f] * facing.weight;
        }
    }
    sums
}
