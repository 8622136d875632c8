//! What a pass tells of itself, beside its twin.

use crate::fields::Field;
use crate::method::{Condition, Method};
use crate::rows::Clock;

/// What one dispatch runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// One invocation a particle.
    Particles,
    /// The same, but the pass binds the neighbour list, and so is dispatched for each of its parts.
    Listed,
    /// One invocation a facet.
    Facets,
    /// One workgroup of 256 for each [`crate::fields::REDUCTION_BLOCK`] facets.
    FacetBlocks,
    /// One invocation a cell.
    Cells,
    /// One workgroup of 256 for each [`crate::fields::SCAN_BLOCK`] cells.
    ScanBlocks,
    /// One workgroup of 256 for each [`crate::fields::REDUCTION_BLOCK`] particles.
    ReductionBlocks,
    /// One workgroup of 256.
    One,
}

/// An entry point of a pass's shader and what it runs over.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    pub name: &'static str,
    pub domain: Domain,
}

impl Entry {
    pub const fn new(name: &'static str, domain: Domain) -> Self {
        Self { name, domain }
    }
}

pub const PARTICLES: &[Entry] = &[Entry::new("main", Domain::Particles)];
pub const LISTED: &[Entry] = &[Entry::new("main", Domain::Listed)];
pub const FACETS: &[Entry] = &[Entry::new("main", Domain::Facets)];
pub const CELLS: &[Entry] = &[Entry::new("main", Domain::Cells)];

/// When a pass that is called does something.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Runs {
    Always,
    /// While the clock runs: over a segment's end it leaves the state alone.
    Running,
    /// While the clock runs and lists are built anew.
    Rebuilding,
}

impl Runs {
    pub fn now<R>(self, clock: &Clock<R>) -> bool {
        match self {
            Runs::Always => true,
            Runs::Running => clock.running != 0,
            Runs::Rebuilding => clock.running != 0 && clock.rebuild != 0,
        }
    }
}

/// Fields, and for which methods a pass touches them.
#[derive(Debug, Clone, Copy)]
pub struct Use {
    pub fields: &'static [Field],
    pub when: Option<Condition>,
}

pub const fn always(fields: &'static [Field]) -> Use {
    Use { fields, when: None }
}

pub const fn when(condition: Condition, fields: &'static [Field]) -> Use {
    Use { fields, when: Some(condition) }
}

/// A pass as the rest of the program knows it. What it reads and writes is what its shader binds, as a test makes sure;
/// which of it belongs to others is what ranks would have to exchange.
#[derive(Debug, Clone, Copy)]
pub struct Declaration {
    pub about: &'static str,
    pub entries: &'static [Entry],
    pub runs: Runs,
    /// What it reads of its own row and of what belongs to it: a particle's facets and lists, a facet's particle, cells.
    pub own: &'static [Use],
    /// What it reads of those that it finds in lists and cells.
    pub neighbours: &'static [Use],
    pub writes: &'static [Use],
}

impl Declaration {
    /// The entry point of a shader with one invocation for each row of its domain, which rests when the pass does; none
    /// where the shader has its own.
    pub fn entry(&self) -> Option<String> {
        let &[Entry { name, domain }] = self.entries else { return None };
        let (row, end, call) = match domain {
            Domain::Particles => ("a", "count", "of_particle(a)"),
            Domain::Listed => ("row", "chunk", "of_particle(params.first + row, row)"),
            Domain::Facets => ("e", "facet_count", "of_facet(e)"),
            Domain::Cells => ("cell", "cell_total", "of_cell(cell)"),
            _ => return None,
        };
        let rests = match self.runs {
            Runs::Always => "",
            Runs::Running => " || clock.running == 0u",
            Runs::Rebuilding => " || clock.running == 0u || clock.rebuild == 0u",
        };
        Some(format!(
            "\n@compute @workgroup_size(64)\nfn {name}(invocation: Invocation) {{\n    let {row} = index_of(invocation);\n    \
             if {row} >= params.{end}{rests} {{\n        return;\n    }}\n    {call};\n}}\n"
        ))
    }

    /// Fields that it reads for a method, its own and its neighbours'; some come twice.
    pub fn reads(&self, method: &Method) -> Vec<Field> {
        [fields(self.own, method), fields(self.neighbours, method)].concat()
    }

    pub fn written(&self, method: &Method) -> Vec<Field> {
        fields(self.writes, method)
    }
}

fn fields(uses: &[Use], method: &Method) -> Vec<Field> {
    let held = uses.iter().filter(|used| used.when.is_none_or(|holds| holds(method)));
    held.flat_map(|used| used.fields.iter().copied()).collect()
}
