//! A step read aloud: which passes, in which order, for each integrator; and the fields that these declare.

mod corrected_kernel;

use crate::contact::zones::Normals;
use crate::fields::Field;
use crate::method::{Density, Formulation, Gradient, Integrator, Method};
use crate::pass::{Call, Pass, Stage};
use std::collections::BTreeSet;

fn call(pass: Pass) -> Call {
    Call { pass, stage: Stage::default() }
}

/// Sorts particles into cells. Does nothing while the present list holds.
fn sort(reference: bool, calls: &mut Vec<Call>) {
    let passes = [Pass::BinCells, Pass::ScanCells, Pass::FillCells, Pass::SortCells];
    calls.extend(passes.map(|pass| Call { pass, stage: Stage { reference, ..Stage::default() } }));
}

/// Lists neighbours from cells. Does nothing while the present list holds.
fn list(reference: bool, calls: &mut Vec<Call>) {
    sort(reference, calls);
    calls.push(Call { pass: Pass::FindNeighbors, stage: Stage { reference, ..Stage::default() } });
}

/// A fluid whose density is summed has no stress to carry from step to step.
fn stress_evolves(method: &Method) -> bool {
    method.shear || method.density == Density::Continuity
}

/// Adds the passes that lead from the state to the acceleration.
fn force(method: &Method, calls: &mut Vec<Call>) {
    if let Some(options) = method.corrected_kernel {
        corrected_kernel::force(options, calls);
        return;
    }
    if method.formulation == Formulation::TotalLagrangian {
        calls.push(call(Pass::Deform));
        press_surfaces(method, calls);
        calls.push(call(Pass::BondForce));
        if method.viscosity {
            calls.push(call(Pass::BondFriction));
        }
        contact(method, calls);
        if method.facets() {
            calls.push(call(Pass::SurfaceForce));
        }
        if method.obstacles {
            calls.push(call(Pass::LoadObstacles));
        }
        return;
    }
    if method.density == Density::Summation {
        calls.push(call(Pass::SumDensity));
    }
    if method.gradient == Gradient::Adjoint {
        calls.push(call(Pass::CorrectGradient));
    }
    calls.extend([Pass::SpecificStress, Pass::Force].map(call));
    contact(method, calls);
}

/// Adds what touching bodies do to each other.
fn contact(method: &Method, calls: &mut Vec<Call>) {
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
fn find_surface(fixed: bool, reference: bool, calls: &mut Vec<Call>) {
    let passes = [Pass::FindSurface, Pass::FindNormals].into_iter().skip(usize::from(fixed));
    calls.extend(passes.map(|pass| Call { pass, stage: Stage { reference, ..Stage::default() } }));
}

/// Contact of surfaces: what acts on the facets, and what the bonds carry of it.
fn press_surfaces(method: &Method, calls: &mut Vec<Call>) {
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

/// Brings the columns of particles into cell order, and lists neighbours in that order.
fn order(reference: bool, calls: &mut Vec<Call>) {
    sort(reference, calls);
    calls.push(call(Pass::Reorder));
    list(reference, calls);
}

/// Passes that follow once on a state that is new to the backend, at the start of a run or where one resumes:
/// what the reference configuration fixes.
pub fn prepare(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    if let Some(options) = method.corrected_kernel {
        corrected_kernel::prepare(options, &mut calls);
    }
    if method.formulation == Formulation::TotalLagrangian {
        order(true, &mut calls);
        if method.gradient != Gradient::Plain {
            calls.push(call(Pass::CorrectReference));
        }
        if method.gradient == Gradient::Quadratic {
            calls.push(call(Pass::CorrectQuadratic));
        }
        if method.facets() {
            calls.push(call(Pass::AttachFacets));
        }
    }
    if let Some(zones) = method.contact.zones {
        let initial = zones.normals == Normals::Initial;
        if method.formulation == Formulation::Eulerian && initial {
            // The particles are listed but not reordered: a resumed run then sums in the same order, and so to the same
            // bits, as an unbroken one.
            list(true, &mut calls);
        }
        if method.formulation == Formulation::TotalLagrangian || initial {
            find_surface(false, true, &mut calls);
        }
    }
    calls
}

/// Passes that begin a segment.
pub fn begin_segment(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    if let Some(options) = method.corrected_kernel {
        corrected_kernel::begin_segment(options, &mut calls);
    }
    if method.formulation == Formulation::Eulerian {
        sort(false, &mut calls);
        calls.push(call(Pass::Reorder));
        list_present(method, &mut calls);
    }
    if method.gap.is_some() {
        calls.push(call(Pass::PlaceFacets));
    }
    if method.quasi_static.is_some() {
        calls.push(call(Pass::BeginLoad));
        move_obstacles(method, &mut calls);
        find_contacts(method, &mut calls);
        force(method, &mut calls);
    } else {
        find_contacts(method, &mut calls);
    }
    calls
}

/// Lists contacts, where no list of neighbours follows the particles. Does nothing while the present list holds.
fn find_contacts(method: &Method, calls: &mut Vec<Call>) {
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

fn move_obstacles(method: &Method, calls: &mut Vec<Call>) {
    if method.obstacles {
        calls.push(call(Pass::MoveObstacles));
    }
}

/// Lists neighbours where the particles are now, and from the same cells what they may touch.
fn list_present(method: &Method, calls: &mut Vec<Call>) {
    list(false, calls);
    if method.contact.any() {
        calls.push(call(Pass::FindContacts));
    }
}

/// Passes that follow once before the first step of a run: leapfrog needs the first acceleration.
pub fn begin_run(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    if method.quasi_static.is_none() {
        force(method, &mut calls);
    }
    calls
}

/// The pass that ends a step, and that bounds the first of a segment.
pub fn bound(method: &Method) -> Call {
    call(if method.quasi_static.is_some() { Pass::BoundResidual } else { Pass::BoundTimeStep })
}

/// One time step, or one step of the descent to equilibrium.
pub fn step(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    if method.quasi_static.is_some() {
        calls.push(call(Pass::Descend));
        find_contacts(method, &mut calls);
        force(method, &mut calls);
        calls.push(bound(method));
        return calls;
    }
    find_contacts(method, &mut calls);
    calls.extend(match method.integrator {
        Integrator::Leapfrog => leapfrog(method),
        Integrator::Rk2 => runge_kutta(method, &HEUN),
        Integrator::SspRk3 => runge_kutta(method, &SHU_OSHER),
        Integrator::Rk4 => runge_kutta(method, &CLASSICAL),
        Integrator::Pefrl => pefrl(method),
    });
    if method.velocity_filter {
        calls.extend([Pass::SmoothVelocity, Pass::FilterVelocity].map(call));
    }
    calls.push(bound(method));
    calls
}

/// Kick, drift, kick, with the stress advanced in the middle of the drift: there positions and velocity
/// are both at the half step, so a rigid rotation makes no strain.
fn leapfrog(method: &Method) -> Vec<Call> {
    let at = |pass, time| Call { pass, stage: Stage { time, ..Stage::default() } };
    let mut calls = vec![at(Pass::Kick, 0.5)];
    if let Some(options) = method.corrected_kernel {
        corrected_kernel::drift(options, &mut calls);
        corrected_kernel::force(options, &mut calls);
        calls.push(at(Pass::Kick, 1.0));
        return calls;
    }
    if method.formulation == Formulation::TotalLagrangian {
        calls.push(drift_by(1.0));
        move_obstacles(method, &mut calls);
        force(method, &mut calls);
        calls.push(at(Pass::Kick, 1.0));
        return calls;
    }
    if method.xsph {
        calls.push(call(Pass::SmoothVelocity));
    }
    calls.push(call(Pass::Drift));
    list_present(method, &mut calls);
    calls.push(call(Pass::StrainRate));
    if stress_evolves(method) {
        calls.push(call(Pass::Stress));
    }
    calls.push(call(Pass::Drift));
    force(method, &mut calls);
    calls.push(at(Pass::Kick, 1.0));
    calls
}

fn drift_by(part: f64) -> Call {
    Call { pass: Pass::Drift, stage: Stage { part, ..Stage::default() } }
}

/// Coefficients of Omelyan, Mryglod & Folk 2002, equation (20).
const XI: f64 = 0.178_617_895_844_809_1;
const LAMBDA: f64 = -0.212_341_831_062_605_4;
const CHI: f64 = -0.066_264_582_669_818_5;

/// Drift, kick, drift, kick … so that the errors of third order cancel.
fn pefrl(method: &Method) -> Vec<Call> {
    let drifts = [XI, CHI, 1.0 - 2.0 * (CHI + XI), CHI, XI];
    let kicks = [0.5 - LAMBDA, LAMBDA, LAMBDA, 0.5 - LAMBDA];
    let mut calls = Vec::new();
    let mut time = 0.0;
    for (k, &part) in drifts.iter().enumerate() {
        calls.push(drift_by(part));
        time += part;
        if let Some(&part) = kicks.get(k) {
            force(method, &mut calls);
            calls.push(Call { pass: Pass::Kick, stage: Stage { time, part, ..Stage::default() } });
        }
    }
    calls
}

const fn stage(weight: f64, of_sum: f64, of_rate: f64, time: f64) -> Stage {
    Stage { time, weight, of_sum, of_rate, first: false, last: false, part: 0.5, reference: false }
}

const HEUN: [Stage; 2] = [stage(0.5, 0.0, 1.0, 1.0), stage(0.5, 1.0, 0.0, 1.0)];
/// In this form the second stage is start + step (rate_1 + rate_2)/4 = start + step 1.5 sum.
const SHU_OSHER: [Stage; 3] = [stage(1.0 / 6.0, 0.0, 1.0, 1.0), stage(1.0 / 6.0, 1.5, 0.0, 0.5), stage(2.0 / 3.0, 1.0, 0.0, 1.0)];
const CLASSICAL: [Stage; 4] = [
    stage(1.0 / 6.0, 0.0, 0.5, 0.5),
    stage(1.0 / 3.0, 0.0, 0.5, 0.5),
    stage(1.0 / 3.0, 0.0, 1.0, 1.0),
    stage(1.0 / 6.0, 1.0, 0.0, 1.0),
];

fn runge_kutta(method: &Method, stages: &[Stage]) -> Vec<Call> {
    let eulerian = method.formulation == Formulation::Eulerian;
    let mut calls = Vec::new();
    if method.list_follows() {
        list_present(method, &mut calls);
    }
    for (k, &stage) in stages.iter().enumerate() {
        if eulerian {
            calls.push(call(Pass::StrainRate));
        }
        if eulerian && stress_evolves(method) {
            calls.push(call(Pass::StressRate));
        }
        if method.xsph {
            calls.push(call(Pass::SmoothVelocity));
        }
        force(method, &mut calls);
        if method.corrected_kernel.is_some_and(|options| options.evolved()) {
            calls.push(call(Pass::EvolveDeformation));
        }
        let stage = Stage { first: k == 0, last: k + 1 == stages.len(), ..stage };
        calls.push(Call { pass: Pass::RungeKutta, stage });
    }
    calls
}

/// Passes that bring fields up to date before they are fetched: those that only observers read, and those that an
/// integrator leaves at one of its stages.
pub fn before_fetch(method: &Method, wanted: &[Field]) -> Vec<Call> {
    let mut calls = Vec::new();
    let behind = method.integrator != Integrator::Leapfrog;
    let integrated = method.corrected_kernel.is_some_and(|options| options.evolved());
    let dependent = match method.formulation {
        Formulation::Eulerian => &[Field::ContactEnergy][..],
        _ if integrated => &[Field::Acceleration],
        _ => &[Field::Acceleration, Field::ContactEnergy, Field::DisplacementGradient],
    };
    if behind && wanted.iter().any(|field| dependent.contains(field)) {
        force(method, &mut calls);
    }
    if method.hourglass && wanted.contains(&Field::HourglassEnergy) {
        calls.push(call(Pass::HourglassEnergy));
    }
    calls
}

/// Fields that a run keeps though no pass may touch them: a particle's number, by which outputs are put in order, and
/// what the particle was packed and set off with, which observers read and a checkpoint holds.
const KEPT: &[Field] = &[Field::Number, Field::ReferencePosition, Field::ReferenceVolume, Field::Displacement, Field::Velocity];

/// Fields that the passes of this method read or write as they declare, and those that every run keeps; no others. In
/// the order of their list.
pub fn fields(method: &Method) -> Vec<Field> {
    let declared = passes(method).into_iter().flat_map(|pass| {
        let declaration = pass.declaration();
        [declaration.reads(method), declaration.written(method)].concat()
    });
    let needed: BTreeSet<Field> = declared.chain(KEPT.iter().copied()).collect();
    needed.into_iter().collect()
}

/// All calls of a run of this method, each with the stage of the run that makes it. The stage `before_fetch` is that of a
/// fetch of all fields.
pub fn calls(method: &Method) -> Vec<(&'static str, Call)> {
    let stages = [
        ("prepare", prepare(method)),
        ("begin_segment", begin_segment(method)),
        ("begin_run", begin_run(method)),
        ("step", step(method)),
        ("before_fetch", before_fetch(method, &fields(method))),
    ];
    stages.into_iter().flat_map(|(stage, calls)| calls.into_iter().map(move |call| (stage, call))).collect()
}

/// Every pass that a run of this method dispatches, each once, in order of first use.
pub fn passes(method: &Method) -> Vec<Pass> {
    // Of what precedes a fetch, all but the energy of hourglasses belongs to the steps too.
    let fetched = before_fetch(method, &[Field::HourglassEnergy]);
    let stages = [prepare(method), begin_segment(method), begin_run(method), step(method), fetched];
    let mut list: Vec<Pass> = Vec::new();
    for call in stages.into_iter().flatten() {
        if !list.contains(&call.pass) {
            list.push(call.pass);
        }
    }
    list
}
