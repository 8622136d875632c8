//! Kernels that are not corrected where the surface cuts them.

use crate::study::atlas::side::{set, text};
use crate::study::atlas::{Bound, Measure, Row, Side, Text, Trace};

const PLATE: Text = text!("scenes/sheared_plate_shutov.toml");

pub static ENERGY: Row = Row {
    name: "energy_of_bare_kernels",
    failure: "A free plate is set shearing. With bare kernels the velocity gradient and the force do not belong together: \
              the energy swings by a tenth at first, then grows until particles turn inside out. Liu's full correction of the \
              kernels keeps it.",
    source: "Shutov & Klyuchantsev 2019, section 6.1, figure 3",
    plain: Side::new("bare kernels", PLATE).variant("bare").changes(|| set(&["duration=6"])),
    remedy: Side::new("fully corrected kernels", PLATE).changes(|| set(&["duration=6"])),
    measure: Measure { about: "largest energy over that of the start", of: |run| Ok(run.most("total")? / run.first("total")?) },
    fails: Bound::Above(10.0),
    survives: Bound::Below(1.01),
    trace: Some(Trace { series: "total", about: "total energy (mJ)", log: true }),
    small: &[],
};
