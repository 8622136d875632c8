//! What acts between groups of particles, each of one formulation.
//!
//! A run of several groups has one member more than groups: the last one owns no matter. It holds the positions, velocities and
//! accelerations of all groups' particles, one group after the other, lists what touches across groups, and adds what touching
//! does to the accelerations. Columns go to and fro as whole ranges, so that every group's own tables, passes and lists are
//! those that it has alone. The last member also brings the groups to one time step, the shortest that any of them asks for.

use super::{before_fetch, begin_run, begin_segment, bound, contact, forces_again, phases, prepare, step};
use crate::fields::Field;
use crate::method::{Integrator, Method};
use crate::pass::{Call, Pass};

/// One thing that a run does next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Act {
    /// A pass of a member.
    Call(usize, Call),
    /// Copies fields of the groups, where they have them, to their ranges of the last member's columns.
    Collect(&'static [Field]),
    /// The other way.
    Spread(&'static [Field]),
    /// Copies the groups' clocks to the last member, or from there.
    CollectClocks,
    SpreadClocks,
}

/// All that a run does, by the moment when it does it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Steps {
    /// Once on a state that is new to the backend.
    pub prepare: Vec<Act>,
    pub begin_segment: Vec<Act>,
    /// Once before the first step of a run.
    pub begin_run: Vec<Act>,
    /// The bound on the first step of a segment; every step ends with its own.
    pub bound: Vec<Act>,
    pub step: Vec<Act>,
}

/// What stays the same during a segment.
const FIXED: &[Field] = &[Field::Body, Field::ReferencePosition, Field::ReferenceVolume, Field::Displacement];
const MOVED: &[Field] = &[Field::Displacement, Field::Acceleration];
const FORCED: &[Field] = &[Field::Acceleration];
const AT_END: &[Field] = &[Field::Displacement, Field::Velocity];

/// What the last member adds to the accelerations.
pub(super) fn force(method: &Method, calls: &mut Vec<Call>) {
    contact::force(method, calls);
}

/// The last member's part of a step: its list, its force after each of the groups' forces, and the common bound.
pub(super) fn parts(method: &Method) -> Vec<Vec<Call>> {
    let forces = match method.integrator {
        Integrator::Leapfrog => 1,
        Integrator::Rk2 => 2,
        Integrator::SspRk3 => 3,
        Integrator::Rk4 | Integrator::Pefrl => 4,
    };
    let part = |add: fn(&Method, &mut Vec<Call>)| {
        let mut calls = Vec::new();
        add(method, &mut calls);
        calls
    };
    let mut parts = vec![part(contact::find)];
    parts.extend(std::iter::repeat_n(part(force), forces));
    parts.push(vec![bound(method)]);
    parts
}

/// The acts of a run whose members have these methods: one group, or several and what acts between them.
pub fn steps(members: &[Method]) -> Steps {
    let [groups @ .., between] = members else { return Steps::default() };
    if groups.is_empty() {
        let own = |calls: Vec<Call>| calls.into_iter().map(|call| Act::Call(0, call)).collect();
        return Steps {
            prepare: own(prepare(between)),
            begin_segment: own(begin_segment(between)),
            begin_run: own(begin_run(between)),
            bound: own(vec![bound(between)]),
            step: own(step(between)),
        };
    }
    let together = Together { groups, between };
    let each = |calls: fn(&Method) -> Vec<Call>| together.each(calls);
    let listing = together.touching(FIXED, begin_segment(between), &[]);
    Steps {
        prepare: each(prepare),
        begin_segment: [each(begin_segment), listing].concat(),
        begin_run: together.forces(),
        bound: [each(|method| vec![bound(method)]), together.bound()].concat(),
        step: together.step(),
    }
}

/// What brings fields up to date before they are fetched.
pub fn refresh(members: &[Method], wanted: &[Field]) -> Vec<Act> {
    let [groups @ .., between] = members else { return Vec::new() };
    if groups.is_empty() {
        return before_fetch(between, wanted).into_iter().map(|call| Act::Call(0, call)).collect();
    }
    let together = Together { groups, between };
    let again = groups.iter().any(|method| forces_again(method, wanted));
    let forces = if again { together.forces() } else { Vec::new() };
    let observed = together.each(|method| {
        let calls = before_fetch(method, wanted);
        calls.into_iter().filter(|call| call.pass == Pass::HourglassEnergy).collect()
    });
    [forces, observed].concat()
}

/// Several groups, and what acts between them.
struct Together<'a> {
    groups: &'a [Method],
    between: &'a Method,
}

impl Together<'_> {
    /// Calls of every group, one group after the other.
    fn each(&self, calls: impl Fn(&Method) -> Vec<Call>) -> Vec<Act> {
        let of_group = |(member, method)| calls(method).into_iter().map(move |call| Act::Call(member, call));
        self.groups.iter().enumerate().flat_map(of_group).collect()
    }

    /// Calls of the last member, with what it needs to know before and what the groups need to know after. Where nothing
    /// touches across groups there is nothing to tell.
    fn touching(&self, fields: &'static [Field], calls: Vec<Call>, told: &'static [Field]) -> Vec<Act> {
        if !self.between.contact.any() {
            return Vec::new();
        }
        let mut acts: Vec<Act> = (!fields.is_empty()).then_some(Act::Collect(fields)).into_iter().collect();
        acts.extend(calls.into_iter().map(|call| Act::Call(self.groups.len(), call)));
        acts.extend((!told.is_empty()).then_some(Act::Spread(told)));
        acts
    }

    /// The accelerations of the first step.
    fn forces(&self) -> Vec<Act> {
        [self.each(begin_run), self.touching(MOVED, begin_run(self.between), FORCED)].concat()
    }

    /// The common bound on the step, after the groups' own.
    fn bound(&self) -> Vec<Act> {
        let mut acts = self.touching(AT_END, Vec::new(), &[]);
        acts.push(Act::CollectClocks);
        acts.push(Act::Call(self.groups.len(), bound(self.between)));
        acts.push(Act::SpreadClocks);
        acts
    }

    fn step(&self) -> Vec<Act> {
        let of_groups: Vec<Vec<Vec<Call>>> = self.groups.iter().map(phases).collect();
        let parts = parts(self.between);
        let forces = &parts[1..parts.len() - 1];
        // Displacements are those of the bound that ended the step before.
        let mut acts = self.touching(&[], parts[0].clone(), &[]);
        let phase = |k: usize| {
            let of_group = |(member, phases): (usize, &Vec<Vec<Call>>)| {
                phases[k].clone().into_iter().map(move |call| Act::Call(member, call))
            };
            of_groups.iter().enumerate().flat_map(of_group).collect::<Vec<_>>()
        };
        for (k, force) in forces.iter().enumerate() {
            acts.extend(phase(k));
            acts.extend(self.touching(MOVED, force.clone(), FORCED));
        }
        acts.extend(phase(forces.len()));
        acts.extend(self.bound());
        acts
    }
}
