//! A step read aloud: which passes, in which order, for each integrator; and which fields they need.

use crate::particles::Field;
use crate::pass::{Call, Pass, Stage};
use crate::scene::file::{ArtificialForm, Density, Gradient, Integrator};
use crate::state::Method;

fn call(pass: Pass) -> Call {
    Call { pass, stage: Stage::default() }
}

/// Sorts particles into cells. Does nothing while the present list holds.
fn sort(calls: &mut Vec<Call>) {
    calls.extend([Pass::BinCells, Pass::ScanCells, Pass::FillCells, Pass::SortCells].map(call));
}

/// Lists neighbours from cells. Does nothing while the present list holds.
fn list(calls: &mut Vec<Call>) {
    sort(calls);
    calls.push(call(Pass::FindNeighbors));
}

/// A fluid whose density is summed has no stress to carry from step to step.
fn stress_evolves(method: &Method) -> bool {
    method.shear || method.density == Density::Continuity
}

/// From state to acceleration.
fn force(method: &Method, calls: &mut Vec<Call>) {
    if method.density == Density::Summation {
        calls.push(call(Pass::SumDensity));
    }
    if method.gradient == Gradient::Adjoint {
        calls.push(call(Pass::CorrectGradient));
    }
    calls.extend([Pass::SpecificStress, Pass::Force].map(call));
}

/// Passes that begin a segment: particles into cell order, a fresh list.
pub fn begin_segment() -> Vec<Call> {
    let mut calls = Vec::new();
    sort(&mut calls);
    calls.push(call(Pass::Reorder));
    list(&mut calls);
    calls
}

/// Passes that follow once before the first step of a run: leapfrog needs the first acceleration.
pub fn begin_run(method: &Method) -> Vec<Call> {
    let mut calls = Vec::new();
    force(method, &mut calls);
    calls
}

/// One time step.
pub fn step(method: &Method) -> Vec<Call> {
    let mut calls = match method.integrator {
        Integrator::Leapfrog => leapfrog(method),
        Integrator::Rk2 => runge_kutta(method, &HEUN),
        Integrator::SspRk3 => runge_kutta(method, &SHU_OSHER),
        Integrator::Rk4 => runge_kutta(method, &CLASSICAL),
    };
    if method.velocity_filter {
        calls.extend([Pass::SmoothVelocity, Pass::FilterVelocity].map(call));
    }
    calls.push(call(Pass::BoundTimeStep));
    calls
}

/// Kick, drift, kick, with the stress advanced in the middle of the drift: there positions and velocity
/// are both at the half step, so a rigid rotation makes no strain.
fn leapfrog(method: &Method) -> Vec<Call> {
    let at = |pass, time| Call { pass, stage: Stage { time, ..Stage::default() } };
    let mut calls = vec![at(Pass::Kick, 0.5)];
    if method.xsph {
        calls.push(call(Pass::SmoothVelocity));
    }
    calls.push(call(Pass::Drift));
    list(&mut calls);
    calls.push(call(Pass::StrainRate));
    if stress_evolves(method) {
        calls.push(call(Pass::Stress));
    }
    calls.push(call(Pass::Drift));
    force(method, &mut calls);
    calls.push(at(Pass::Kick, 1.0));
    calls
}

const fn stage(weight: f64, of_sum: f64, of_rate: f64, time: f64) -> Stage {
    Stage { time, weight, of_sum, of_rate, first: false, last: false }
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
    let mut calls = Vec::new();
    list(&mut calls);
    for (k, &stage) in stages.iter().enumerate() {
        calls.push(call(Pass::StrainRate));
        if stress_evolves(method) {
            calls.push(call(Pass::StressRate));
        }
        if method.xsph {
            calls.push(call(Pass::SmoothVelocity));
        }
        force(method, &mut calls);
        let stage = Stage { first: k == 0, last: k + 1 == stages.len(), ..stage };
        calls.push(Call { pass: Pass::RungeKutta, stage });
    }
    calls
}

/// Fields that the passes of this method read or write, and no others.
pub fn fields(method: &Method) -> Vec<Field> {
    use Field::*;
    let leapfrog = method.integrator == Integrator::Leapfrog;
    let adjoint = method.gradient == Gradient::Adjoint;
    let continuity = method.density == Density::Continuity;
    let wanted = [
        (true, &[Number, ReferencePosition, ReferenceVolume, Displacement, Velocity, Acceleration][..]),
        (true, &[VolumetricStrain, VelocityGradient, ListedDisplacement, Cell, NeighborCount]),
        (method.many_bodies, &[Body]),
        (method.constraints, &[Field::Constraint]),
        (method.compensated, &[DisplacementCarry, VelocityCarry]),
        (method.shear, &[DeviatoricStress]),
        (method.internal_energy, &[InternalEnergy, InternalPower]),
        (method.dissipated_energy, &[DissipatedEnergy, DissipatedPower]),
        (method.xsph || method.velocity_filter, &[SmoothedVelocity]),
        (adjoint, &[Correction, CorrectedStress]),
        (!adjoint, &[Field::SpecificStress]),
        (method.artificial_stress == Some(ArtificialForm::Scalar), &[ArtificialPressure]),
        (method.artificial_stress == Some(ArtificialForm::Principal), &[Field::ArtificialStress]),
        (!leapfrog, &[DisplacementStart, VelocityStart, DisplacementSum, VelocitySum]),
        (!leapfrog && continuity, &[VolumetricStrainRate, VolumetricStrainStart, VolumetricStrainSum]),
        (!leapfrog && method.shear, &[DeviatoricStressRate, DeviatoricStressStart, DeviatoricStressSum]),
        (!leapfrog && method.internal_energy, &[InternalEnergyStart, InternalEnergySum]),
        (!leapfrog && method.dissipated_energy, &[DissipatedEnergyStart, DissipatedEnergySum]),
    ];
    let mut list: Vec<Field> = wanted.iter().filter(|(on, _)| *on).flat_map(|(_, f)| f.iter().copied()).collect();
    list.sort_unstable();
    list
}

/// Every pass that a run of this method dispatches, each once, in order of first use.
pub fn passes(method: &Method) -> Vec<Pass> {
    let mut list: Vec<Pass> = Vec::new();
    for call in begin_segment().into_iter().chain(begin_run(method)).chain(step(method)) {
        if !list.contains(&call.pass) {
            list.push(call.pass);
        }
    }
    list
}
