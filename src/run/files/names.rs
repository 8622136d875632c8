//! Names of a run's files that several of its parts ask for.

pub const SERIES: &str = "series.csv";
pub const SUMMARY: &str = "summary.json";
pub const PARTICLES: &str = "particles.vtkhdf";

/// A frame: the number of its files, time and step.
pub type Frame = (u32, f64, u64);

pub fn picture_name(number: u32) -> String {
    format!("frames/{number:05}.png")
}
