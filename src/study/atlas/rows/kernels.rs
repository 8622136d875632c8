//! Kernels that are not corrected where the surface cuts them.

use super::measures::NEAREST;
use crate::study::atlas::side::{set, text};
use crate::study::atlas::{Bound, Measure, Row, Side, Text, Trace};

const PLATE: Text = text!("scenes/sheared_plate_shutov.toml");

pub static ENERGY: Row = Row {
    name: "energy_of_bare_kernels",
    failure: "A free plate is set shearing. With bare kernels the velocity gradient and the force do not belong together: \
              the energy swings by a tenth at first, then grows until particles turn inside out. Liu's full correction of the \
              kernels keeps it, though not the order of the particles: see disorder of corrected kernels.",
    source: "Shutov & Klyuchantsev 2019, section 6.1, figure 3",
    plain: Side::new("bare kernels", PLATE).variant("bare").changes(|| set(&["duration=6"])),
    remedy: Side::new("fully corrected kernels", PLATE).changes(|| set(&["duration=6"])),
    measure: Measure { about: "largest energy over that of the start", of: |run| Ok(run.most("total")? / run.first("total")?) },
    fails: Bound::Above(10.0),
    survives: Bound::Below(1.01),
    trace: Some(Trace { series: "total", about: "total energy (mJ)", log: true }),
    small: &[],
};

const DISORDER: &str = "observe.disorder={ kind = \"disorder\" }";

pub static DISORDER_GROWS: Row = Row {
    name: "disorder_of_corrected_kernels",
    failure: "The same plate by fully corrected kernels. With sums in the current configuration its particles leave their order \
              from 2.5 s on; the energy, and the corner, right to 0.001 mm still at 3 s, do not tell. With sums in the reference \
              configuration they stay where the strain puts them.",
    source: "Shutov & Klyuchantsev 2019, whose figures end at 1.2 s; this program's own longer runs",
    plain: Side::new("corrected kernels, current configuration", PLATE).changes(|| set(&["duration=6", DISORDER])),
    remedy: Side::new("corrected kernels, reference configuration", PLATE)
        .variant("reference")
        .changes(|| set(&["duration=6", DISORDER])),
    measure: Measure { about: "disorder at the end, in spacings", of: |run| run.last("disorder") },
    fails: Bound::Above(0.15),
    survives: Bound::Below(0.07),
    trace: Some(Trace { series: "disorder", about: "disorder in spacings", log: false }),
    small: &[],
};

const BLOCK: Text = text!("src/study/atlas/rows/free_block.toml");

pub static SUMMATION: Row = Row {
    name: "density_by_summation",
    failure: "The sum of the neighbours' masses misses what lies beyond a free surface: density there is too low, a block at rest \
              is in tension without a load and pulls itself out of order. The continuity equation starts from the right density \
              and leaves the block alone.",
    source: "Fuller 2010, (2.21) and (2.22)",
    plain: Side::new("density by summation", BLOCK),
    remedy: Side::new("density by continuity", BLOCK).changes(|| set(&["formulation.density=continuity"])),
    measure: NEAREST,
    fails: Bound::Below(0.6),
    survives: Bound::Above(0.999999),
    trace: Some(Trace { series: "nearest", about: "least distance in spacings", log: false }),
    small: &[],
};
