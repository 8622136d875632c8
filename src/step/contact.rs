//! What touching bodies of one group do to each other, and what obstacles do to them.

use super::{call, placed, sort};
use crate::contact::zones::Normals;
use crate::method::{Formulation, Method};
use crate::pass::{Call, Pass};

/// Lists contacts, where no list of neighbours follows the particles. Does nothing while the present list holds.
pub(super) fn find(method: &Method, calls: &mut Vec<Call>) {
    if method.list_follows() || !(method.contact.any() || method.gap.is_some()) {
        return;
    }
    sort(false, calls);
    if method.contact.any() {
        calls.push(call(Pass::FindContacts));
    }
    if method.gap.is_some() {
        calls.extend([Pass::KeepListed, Pass::FindFacetContacts].map(call));
    }
}

/// Adds the forces of the laws between particles.
pub(super) fn force(method: &Method, calls: &mut Vec<Call>) {
    if method.contact.colour_field {
        calls.push(call(Pass::SumColour));
    }
    if method.contact.with_energy() {
        calls.push(call(Pass::ContactForce));
    }
    if let Some(zones) = method.contact.zones {
        if zones.normals != Normals::Initial {
            find_surface(method.formulation == Formulation::TotalLagrangian, false, calls);
        }
        calls.extend([Pass::PushIntruders, Pass::ZoneForce].map(call));
    }
}

/// Finds surfaces, unless the reference configuration has fixed them, and their normals.
pub(super) fn find_surface(fixed: bool, reference: bool, calls: &mut Vec<Call>) {
    let passes = [Pass::FindSurface, Pass::FindNormals].into_iter().skip(usize::from(fixed));
    calls.extend(passes.map(|pass| placed(pass, reference)));
}

/// Contact of surfaces: what acts on the facets, and what the bonds carry of it.
pub(super) fn press_surfaces(method: &Method, calls: &mut Vec<Call>) {
    let gap = [Pass::PlaceFacets, Pass::MeasureGap, Pass::PressFacets];
    let obstacles = [Pass::TouchObstacles, Pass::CarryFacets];
    let (gap, obstacles) = match (method.gap.is_some(), method.obstacles) {
        (false, false) => return,
        (true, true) => (&gap[..], &obstacles[..]),
        (true, false) => (&gap[..], &obstacles[1..]),
        (false, true) => (&gap[..1], &obstacles[..]),
    };
    calls.extend(gap.iter().chain(obstacles).map(|&pass| call(pass)));
}

pub(super) fn move_obstacles(method: &Method, calls: &mut Vec<Call>) {
    if method.obstacles {
        calls.push(call(Pass::MoveObstacles));
    }
}
