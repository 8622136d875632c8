//! Force of each surface particle, the owner of a zone, on each particle in its list of contacts, Fuller (4.2) and (4.3):
//! see [`crate::contact::zones`]. Zero where the other is not inside. Twin: shaders/pass/push_intruders.wgsl

use super::Stage;
use super::declaration::{Declaration, LISTED, Runs, always, when};
use super::find_surface::own_neighbors;
use super::write::with_columns;
use crate::contact::ZONES;
use crate::contact::zones::{CORNER, penalty};
use crate::method::Formulation;
use crate::pair::separation;
use crate::rows::ContactPair;
use crate::state::State;
use crate::tensor::{Real, Space};

pub const PASS: Declaration = {
    use crate::fields::Field::*;
    Declaration {
        about: "force of the zone of each surface particle on those inside, Fuller (4.2), (4.3)",
        entries: LISTED,
        runs: Runs::Running,
        own: &[
            always(&[ReferencePosition, Displacement, ContactCount, Surface, SurfaceNormal, NeighborCount, Neighbors, Contacts]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.zones_friction(), &[Velocity]),
        ],
        neighbours: &[
            always(&[ReferencePosition, Displacement, SurfaceNormal]),
            when(|m| m.many_bodies, &[Body]),
            when(|m| m.zones_friction(), &[Velocity]),
        ],
        writes: &[always(&[ZoneForces])],
    }
};

pub fn run<S: Space>(state: &mut State<S>, _: Stage) {
    let count = state.params.count as usize;
    with_columns!(state, [zone_forces] => {
        for (a, &kind) in state.columns.surface.iter().enumerate().filter(|(_, kind)| **kind != 0) {
            for (k, b) in state.contacts_of(a).enumerate() {
                zone_forces[k * count + a] = push(state, a, b, kind);
            }
        }
    });
}

/// Force on intruder b by owner a.
fn push<S: Space>(state: &State<S>, a: usize, b: usize, kind: u32) -> S::Vec {
    let pair = state.contact_pair(a, b);
    // x_b - x_a
    let place = separation(state, a, b as u32) * S::Real::of(-1.0);
    let normal = state.columns.surface_normal[a];
    let zero = S::Vec::default();
    if pair.law != ZONES || !in_zone::<S>(place, normal, pair.range) || (kind == CORNER && outside_some(state, a, place, pair)) {
        return zero;
    }
    let form = state.method.contact.zones.unwrap_or_default().form;
    let size = pair.strength * penalty(form, S::inner(place, normal).abs() / pair.range);
    let slip = slip(state, a, b, normal);
    let speed = S::inner(slip, slip).sqrt();
    let friction = if speed > S::Real::of(0.0) { slip * (pair.friction / speed) } else { zero };
    (normal - friction) * size
}

/// Tangential velocity of b over a.
fn slip<S: Space>(state: &State<S>, a: usize, b: usize, normal: S::Vec) -> S::Vec {
    let velocity = &state.columns.velocity;
    let apart = velocity[b] - velocity[a];
    apart - normal * S::inner(apart, normal)
}

/// Whether a place beside the owner lies in the zone with this normal.
fn in_zone<S: Space>(place: S::Vec, normal: S::Vec, half: S::Real) -> bool {
    let along = S::inner(place, normal);
    let across = place - normal * along;
    S::inner(normal, normal) > S::Real::of(0.0) && along.abs() < half && S::inner(across, across) < half * half
}

/// Whether a place lies outside a zone with the normal of some surface particle in the kernel's range of a corner.
fn outside_some<S: Space>(state: &State<S>, a: usize, place: S::Vec, pair: &ContactPair<S::Real>) -> bool {
    let normals = &state.columns.surface_normal;
    let reference = state.method.formulation == Formulation::TotalLagrangian;
    let others = own_neighbors(state, a, reference).map(|(c, _)| normals[c]);
    let real = |normal: &S::Vec| S::inner(*normal, *normal) > S::Real::of(0.0);
    others.filter(real).any(|normal| !in_zone::<S>(place, normal, pair.range))
}
