//! What a backend does for a run.

use crate::fields::{Field, Set};
use crate::pass::Call;
use crate::rows::Clock;
use std::collections::BTreeMap;

/// Columns as the host keeps them: f64, padded as the space pads them; integers as whole numbers.
pub type Fetched = BTreeMap<Field, Vec<f64>>;

/// A group's carried fields.
pub type Saved = BTreeMap<Field, Vec<u8>>;

/// What a fetch brings of one member: its fields, and how many particles it has.
pub(super) struct Part {
    pub particles: usize,
    pub columns: Fetched,
}

/// The columns of a run of several groups, each member's in its own rows, as those of one: particles of the groups one after
/// the other, with zeros where a group lacks the field. What is between groups adds its energy of contact to the groups' own.
/// All else, facets and obstacles, one group has.
pub(super) fn joined(fields: &[Field], parts: &[Part], words: impl Fn(Field) -> usize) -> Result<Fetched, String> {
    let [groups @ .., between] = parts else { return Ok(Fetched::new()) };
    let mut all = Fetched::new();
    for &field in fields {
        let mut holders = groups.iter().filter_map(|group| group.columns.get(&field));
        let column = if field.set() == Set::Particle {
            let rows =
                |group: &Part| group.columns.get(&field).cloned().unwrap_or_else(|| vec![0.0; group.particles * words(field)]);
            let mut column: Vec<f64> = groups.iter().flat_map(rows).collect();
            if field == Field::ContactEnergy
                && let Some(across) = between.columns.get(&field)
            {
                column.iter_mut().zip(across).for_each(|(own, across)| *own += across);
            }
            column
        } else {
            holders.next().cloned().ok_or_else(|| format!("no group of this run has the field {}", field.name()))?
        };
        all.insert(field, column);
    }
    Ok(all)
}

/// The machine that steps a run.
pub trait Backend {
    /// One line: device, driver, precision.
    fn describe(&self) -> String;
    /// Bytes that all tables take on the device.
    fn bytes(&self) -> u64;
    /// Begins a segment: sets the clock, sorts the particles, builds the list, bounds the first step.
    /// `first` also computes the first acceleration of a run.
    fn begin_segment(&mut self, start: f64, duration: f64, steps: u32, first: bool) -> Result<(), String>;
    /// Advances by some steps, as many as keep the host responsive, and tells how far the device is.
    fn advance(&mut self) -> Result<Clock<f64>, String>;
    /// Brings fields to the host.
    fn fetch(&mut self, fields: &[Field]) -> Result<Fetched, String>;
    /// Each group's carried fields as raw bytes in their present order, for a checkpoint that resumes bit for bit.
    fn save(&mut self) -> Result<Vec<Saved>, String>;
    fn load(&mut self, groups: &[Saved]) -> Result<(), String>;
    /// The clocks of all members, for a checkpoint.
    fn clocks(&mut self) -> Result<Vec<Clock<f64>>, String>;
    /// Sets what the clocks have counted and the step that they hold, when a run resumes.
    fn set_clocks(&mut self, clocks: &[Clock<f64>]) -> Result<(), String>;
    /// Seconds spent in each pass of one step, for the benchmark.
    fn time_passes(&mut self, calls: &[Call], repeats: u32) -> Result<Vec<(String, f64)>, String>;
}
