//! Distance of each facet from the surface that faces it, and what follows from it: the derivatives of its energy,
//! and friction. See [`crate::facet`]. A facet that presses on the other surface marks itself and the facets in its list as
//! pressed; the passes that follow skip all others, whose forces are zero. Twin: shaders/pass/measure_gap.wgsl

use super::Stage;
use super::write::{GRAIN, write_rows};
use crate::facet::{facing, fade, stick};
use crate::rows::FacetPair;
use crate::state::State;
use crate::tensor::{Real, Space};

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
    if state.clock.running == 0 {
        return;
    }
    let mut own = std::mem::take(&mut state.particles);
    let take = std::mem::take::<Vec<S::Real>>;
    let (mut gap, mut spread, mut pull) = (take(&mut own.facet_gap), take(&mut own.facet_spread), take(&mut own.facet_pull));
    let (mut edge, mut pressure) = (take(&mut own.facet_edge), take(&mut own.facet_pressure));
    let (mut energy, mut heat) = (take(&mut own.facet_energy), take(&mut own.facet_heat));
    let mut traction = std::mem::take(&mut own.facet_traction);
    let mut slip = if state.method.friction { own.facet_slip.clone() } else { Vec::new() };
    state.particles = own;
    let measured = ((&mut gap[..], &mut spread[..]), (&mut pull[..], &mut edge[..]));
    let rows = (measured, (&mut pressure[..], &mut energy[..]));
    let found = |e: usize| if state.particles.facet_contact_count[e] > 0 { measure(state, e) } else { Contact::default() };
    if state.method.friction {
        let rubbed = (&mut slip[..], (&mut traction[..], &mut heat[..]));
        write_rows((rows, rubbed), GRAIN, |e, (row, (slip, (traction, heat)))| {
            let contact = found(e);
            (*slip, *traction, *heat) = (contact.slip, contact.traction, contact.heat);
            contact.put(row);
        });
    } else {
        write_rows(rows, GRAIN, |e, row| found(e).put(row));
    }
    tell(state, &pull);
    let own = &mut state.particles;
    (own.facet_gap, own.facet_spread, own.facet_pull) = (gap, spread, pull);
    (own.facet_edge, own.facet_pressure, own.facet_energy) = (edge, pressure, energy);
    (own.facet_slip, own.facet_traction, own.facet_heat) =
        if state.method.friction { (slip, traction, heat) } else { Default::default() };
}

/// Marks each facet that presses, and every facet in its list. Some of the marked ones are only near and feel nothing; to
/// mark them too costs less than to sort them out.
fn tell<S: Space>(state: &mut State<S>, pulls: &[S::Real]) {
    let total = state.params.facet_count as usize;
    let columns = &mut state.particles;
    for (e, _) in pulls.iter().enumerate().filter(|(_, pull)| **pull != S::Real::of(0.0)) {
        columns.facet_pressed[e] = 1;
        for k in 0..columns.facet_contact_count[e] as usize {
            columns.facet_pressed[state.facet_contacts[k * total + e] as usize] = 1;
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
    let stiffness = pair.stiffness * state.particles.facet_area[e];
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
        pressure: force / state.particles.facet_area[e],
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
    let slip = state.particles.facet_slip.get(e).copied().unwrap_or_default();
    S::Real::of(0.5) * stiffness * S::inner(slip, slip)
}

/// The tangential spring, which stretches by the distance that the facet slips over the other surface.
fn rub<S: Space>(state: &State<S>, e: usize, sums: &Sums<S>, stiffness: S::Real, force: S::Real, contact: &mut ContactIn<S>) {
    let columns = &state.particles;
    let length = S::inner(sums.normal, sums.normal).sqrt();
    let normal = sums.normal * (S::Real::of(1.0) / length);
    let grown = columns.facet_slip[e] + columns.facet_move[e] - sums.moved * contact.spread;
    let along = grown - normal * S::inner(grown, normal);
    let (slip, heat) = stick::<S>(along, stiffness, sums.pair.friction * force);
    contact.slip = slip;
    contact.heat = heat;
    contact.traction = slip * (S::Real::of(0.0) - stiffness);
    contact.energy += S::Real::of(0.5) * stiffness * S::inner(slip, slip);
}

#[inline(always)]
fn sum<S: Space>(state: &State<S>, e: usize) -> Sums<S> {
    let columns = &state.particles;
    let (total, zero) = (state.params.facet_count as usize, S::Real::of(0.0));
    let a = columns.facet_owner[e] as usize;
    let (moved, normal) = (S::Vec::default(), S::Vec::default());
    let mut sums = Sums::<S> { weight: zero, distance: zero, moved, normal, pair: FacetPair::default() };
    for k in 0..columns.facet_contact_count[e] as usize {
        let f = state.facet_contacts[k * total + e] as usize;
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
