//! A step read aloud: which passes, in which order, for each integrator; and the fields that these declare.
//!
//! Each formulation has a file whose functions have the same names: what a state that is new to the backend needs, what begins a
//! segment, what leads from one force to the next, and the force. [`between`] has what acts between groups of particles of
//! different formulations.

mod between;
mod contact;
mod corrected_kernel;
mod eulerian;
mod limit;
mod total_lagrangian;

pub use between::{Act, Steps, refresh, steps};
pub use limit::{amplification, longest_step};

use crate::fields::Field;
use crate::method::{Formulation, Integrator, Method};
use crate::pass::{Call, Pass, Stage};
use std::collections::BTreeSet;

/// Calls a function of the method's formulation.
macro_rules! of_formulation {
    ($function:ident($method:expr, $calls:expr)) => {
        match $method.formulation {
            Formulation::Eulerian => eulerian::$function($method, $calls),
            Formulation::TotalLagrangian => total_lagrangian::$function($method, $calls),
            Formulation::CorrectedKernel => corrected_kernel::$function($method, $calls),
        }
    };
}

fn call(pass: Pass) -> Call {
    Call { pass, stage: Stage::default() }
}

/// A call of a pass that works on the positions of the reference configuration, or else on the present ones.
fn placed(pass: Pass, reference: bool) -> Call {
    Call { pass, stage: Stage { reference, ..Stage::default() } }
}

fn drift_by(part: f64) -> Call {
    Call { pass: Pass::Drift, stage: Stage { part, ..Stage::default() } }
}

/// Sorts particles into cells. Does nothing while the present list holds.
fn sort(reference: bool, calls: &mut Vec<Call>) {
    let passes = [Pass::BinCells, Pass::ScanCells, Pass::FillCells, Pass::SortCells];
    calls.extend(passes.map(|pass| placed(pass, reference)));
}

/// Lists neighbours from cells. Does nothing while the present list holds.
fn list(reference: bool, calls: &mut Vec<Call>) {
    sort(reference, calls);
    calls.push(placed(Pass::FindNeighbors, reference));
}

/// Brings the columns of particles into cell order, and lists neighbours in that order.
fn order(reference: bool, calls: &mut Vec<Call>) {
    sort(reference, calls);
    calls.push(call(Pass::Reorder));
    list(reference, calls);
}

/// Lists neighbours where the particles are now, and from the same cells what they may touch.
fn list_present(method: &Method, calls: &mut Vec<Call>) {
    list(false, calls);
    if method.contact.any() {
        calls.push(call(Pass::FindContacts));
    }
}

/// Adds the passes that lead from the state to the acceleration.
fn force(method: &Method, calls: &mut Vec<Call>) {
    of_formulation!(force(method, calls));
}

/// Passes that follow once on a state that is new to the backend, at the start of a run or where one resumes:
/// what the reference configuration fixes.
pub fn prepare(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    if !method.between {
        of_formulation!(prepare(method, &mut calls));
    }
    calls
}

/// Passes that begin a segment.
pub fn begin_segment(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    if method.between {
        contact::find(method, &mut calls);
        return calls;
    }
    of_formulation!(begin_segment(method, &mut calls));
    if method.gap.is_some() {
        calls.push(call(Pass::PlaceFacets));
    }
    if method.quasi_static.is_some() {
        calls.push(call(Pass::BeginLoad));
        contact::move_obstacles(method, &mut calls);
        contact::find(method, &mut calls);
        force(method, &mut calls);
    } else {
        contact::find(method, &mut calls);
    }
    calls
}

/// Passes that follow once before the first step of a run: leapfrog needs the first acceleration.
pub fn begin_run(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    if method.between {
        between::force(method, &mut calls);
    } else if method.quasi_static.is_none() {
        force(method, &mut calls);
    }
    calls
}

/// The pass that ends a step, and that bounds the first of a segment.
pub fn bound(method: &Method) -> Call {
    call(match method.quasi_static {
        _ if method.between => Pass::BoundBetween,
        Some(_) => Pass::BoundResidual,
        None => Pass::BoundTimeStep,
    })
}

/// One time step, or one step of the descent to equilibrium.
pub fn step(method: &Method) -> Vec<Call> {
    phases(method).concat()
}

/// A step in parts, each but the last of which ends with the acceleration by what is inside the group: there groups act on
/// each other. What acts between them has a part for each such place.
fn phases(method: &Method) -> Vec<Vec<Call>> {
    let mut calls = Vec::new();
    if method.between {
        return between::parts(method);
    }
    if method.quasi_static.is_some() {
        calls.push(call(Pass::Descend));
        contact::find(method, &mut calls);
        force(method, &mut calls);
        calls.push(bound(method));
        return vec![calls];
    }
    contact::find(method, &mut calls);
    let mut phases = vec![calls];
    match method.integrator {
        Integrator::Leapfrog => leapfrog(method, &mut phases),
        Integrator::Rk2 => runge_kutta(method, &HEUN, &mut phases),
        Integrator::SspRk3 => runge_kutta(method, &SHU_OSHER, &mut phases),
        Integrator::Rk4 => runge_kutta(method, &CLASSICAL, &mut phases),
        Integrator::Pefrl => pefrl(method, &mut phases),
    }
    if method.velocity_filter {
        last(&mut phases).extend([Pass::SmoothVelocity, Pass::FilterVelocity].map(call));
    }
    last(&mut phases).push(bound(method));
    phases
}

fn last(phases: &mut Vec<Vec<Call>>) -> &mut Vec<Call> {
    if phases.is_empty() {
        phases.push(Vec::new());
    }
    let end = phases.len() - 1;
    &mut phases[end]
}

/// The force, and after it the end of a phase.
fn end_with_force(method: &Method, phases: &mut Vec<Vec<Call>>) {
    force(method, last(phases));
    phases.push(Vec::new());
}

/// Kick, drift, kick.
fn leapfrog(method: &Method, phases: &mut Vec<Vec<Call>>) {
    let at = |time| Call { pass: Pass::Kick, stage: Stage { time, ..Stage::default() } };
    last(phases).push(at(0.5));
    of_formulation!(drift(method, last(phases)));
    end_with_force(method, phases);
    last(phases).push(at(1.0));
}

/// Coefficients of Omelyan, Mryglod & Folk 2002, equation (20).
const XI: f64 = 0.178_617_895_844_809_1;
const LAMBDA: f64 = -0.212_341_831_062_605_4;
const CHI: f64 = -0.066_264_582_669_818_5;

/// Drift, kick, drift, kick … so that the errors of third order cancel.
fn pefrl(method: &Method, phases: &mut Vec<Vec<Call>>) {
    let drifts = [XI, CHI, 1.0 - 2.0 * (CHI + XI), CHI, XI];
    let kicks = [0.5 - LAMBDA, LAMBDA, LAMBDA, 0.5 - LAMBDA];
    let mut time = 0.0;
    for (k, &part) in drifts.iter().enumerate() {
        last(phases).push(drift_by(part));
        time += part;
        if let Some(&part) = kicks.get(k) {
            end_with_force(method, phases);
            last(phases).push(Call { pass: Pass::Kick, stage: Stage { time, part, ..Stage::default() } });
        }
    }
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

fn runge_kutta(method: &Method, stages: &[Stage], phases: &mut Vec<Vec<Call>>) {
    if method.list_follows() {
        list_present(method, last(phases));
    }
    for (k, &stage) in stages.iter().enumerate() {
        of_formulation!(rates(method, last(phases)));
        end_with_force(method, phases);
        of_formulation!(rates_after_force(method, last(phases)));
        let stage = Stage { first: k == 0, last: k + 1 == stages.len(), ..stage };
        last(phases).push(Call { pass: Pass::RungeKutta, stage });
    }
}

/// Passes that bring fields up to date before they are fetched: those that only observers read, and those that an
/// integrator leaves at one of its stages.
pub fn before_fetch(method: &Method, wanted: &[Field]) -> Vec<Call> {
    let mut calls = Vec::new();
    if forces_again(method, wanted) {
        calls.extend(begin_run(method));
    }
    if method.hourglass && wanted.contains(&Field::HourglassEnergy) {
        calls.push(call(Pass::HourglassEnergy));
    }
    calls
}

/// Whether some of the fields wanted are those of an integrator's last stage, and not of the step's end.
fn forces_again(method: &Method, wanted: &[Field]) -> bool {
    let dependent = match method.formulation {
        Formulation::Eulerian => &[Field::ContactEnergy][..],
        _ if method.evolved() => &[Field::Acceleration],
        _ => &[Field::Acceleration, Field::ContactEnergy, Field::DisplacementGradient],
    };
    method.integrator != Integrator::Leapfrog && wanted.iter().any(|field| dependent.contains(field))
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

/// Every pass that a run of members with these methods dispatches, each once, in order of first use.
pub fn passes_of(members: &[Method]) -> Vec<Pass> {
    let mut seen = BTreeSet::new();
    members.iter().flat_map(passes).filter(|pass| seen.insert(*pass)).collect()
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
