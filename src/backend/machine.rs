//! What a backend does for a run.

use crate::fields::Field;
use crate::pass::Call;
use crate::rows::Clock;
use std::collections::BTreeMap;

/// Columns as the host keeps them: f64, padded as the space pads them; integers as whole numbers.
pub type Fetched = BTreeMap<Field, Vec<f64>>;

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
    /// Carried fields as raw bytes in their present order, for a checkpoint that resumes bit for bit.
    fn save(&mut self) -> Result<BTreeMap<Field, Vec<u8>>, String>;
    fn load(&mut self, columns: &BTreeMap<Field, Vec<u8>>) -> Result<(), String>;
    /// Sets the count of steps, when a run resumes.
    fn set_steps_done(&mut self, steps: u32);
    /// Seconds spent in each pass of one step, for the benchmark.
    fn time_passes(&mut self, calls: &[Call], repeats: u32) -> Result<Vec<(String, f64)>, String>;
}
