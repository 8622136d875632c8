//! What happens in lattices under pressure, and to modes that sums over neighbours do not see.

use super::measures::NEAREST;
use crate::study::atlas::side::text;
use crate::study::atlas::{Bound, Measure, Row, Side, Text, Trace};

const LATTICE: Text = text!("src/study/atlas/rows/compressed_lattice.toml");

pub static PAIRING: Row = Row {
    name: "compression_instability",
    failure: "Where h is so large that the nearest neighbours lie within 2/3 h, the cubic spline's W'' is negative there, and a \
              lattice under pressure is unstable as one in tension is elsewhere: particles pair. Wendland's kernel, whose \
              Fourier transform is positive, keeps them apart at the same h.",
    source: "Swegle, Hicks & Attaway 1995; Dehnen & Aly 2012",
    plain: Side::new("cubic spline, h = 1.8 spacings", LATTICE),
    remedy: Side::new("Wendland's kernel, h = 1.8 spacings", LATTICE).variant("wendland"),
    measure: NEAREST,
    fails: Bound::Below(0.3),
    survives: Bound::Above(0.99),
    trace: Some(Trace { series: "disorder", about: "disorder in spacings", log: true }),
    small: &[],
};

const BLOCK: Text = text!("src/study/atlas/rows/hourglass.toml");

pub static HOURGLASS: Row = Row {
    name: "zero_energy_modes",
    failure: "Particles that move against their neighbours leave the mean strain about each as it is: without stress to stop \
              them they go on until the block is scrambled. The Total Lagrangian formulation needs an hourglass energy, of what \
              a bond does beyond the mean strain.",
    source: "Vidal, Bonet & Huerta 2007; Ganzenmueller 2015",
    plain: Side::new("Total Lagrangian without hourglass energy", BLOCK),
    remedy: Side::new("Total Lagrangian, hourglass energy 0.5", BLOCK).variant("held"),
    measure: Measure { about: "largest disorder, in spacings", of: |run| run.most("disorder") },
    fails: Bound::Above(0.2),
    survives: Bound::Below(0.02),
    trace: Some(Trace { series: "nearest", about: "least distance in spacings", log: false }),
    small: &[],
};
