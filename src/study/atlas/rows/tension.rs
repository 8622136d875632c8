//! Particles that clump in tension, and what artificial stress does about it.

use super::measures::{GROWTH, NEAREST};
use crate::study::atlas::side::{set, text};
use crate::study::atlas::{Bound, Measure, Row, Side, Text, Trace};

const STRIP_SCENE: Text = text!("src/study/atlas/rows/tension.toml");

pub static STRIP: Row = Row {
    name: "tensile_instability",
    failure: "A strip is stretched by a seventeenth and held. In the Eulerian formulation the lattice is unstable wherever W'' \
              times the stress is positive: particles clump and the strip tears. In the Total Lagrangian formulation kernels \
              belong to the reference configuration, and nothing clumps.",
    source: "Swegle, Hicks & Attaway 1995; Belytschko et al. 2000",
    plain: Side::new("Eulerian, plain gradients", STRIP_SCENE),
    remedy: Side::new("Total Lagrangian", STRIP_SCENE).variant("lagrangian"),
    measure: NEAREST,
    fails: Bound::Below(0.3),
    survives: Bound::Above(0.9),
    trace: Some(Trace { series: "nearest", about: "least distance in spacings", log: false }),
    small: &[],
};

const SQUARE: Text = text!("scenes/tension_square.toml");

const SPEED: Option<Trace> = Some(Trace { series: "speed", about: "rms speed (m/s)", log: true });

pub static LINE: Row = Row {
    name: "tensile_instability_line",
    failure: "A stretched row of particles, held at its ends, is kicked by a millionth of a metre a second. The kick grows by \
              e in 2 microseconds. An artificial stress of 0.3 makes the row stable.",
    source: "Strand 2010, section 5.1; Monaghan 2000",
    plain: Side::new("plain", SQUARE).variant("line"),
    remedy: Side::new("artificial stress 0.3", SQUARE).variant("line_eps03"),
    measure: GROWTH,
    fails: Bound::Above(1e4),
    survives: Bound::Below(1.5),
    trace: SPEED,
    small: &[],
};

pub static PLANE: Row = Row {
    name: "tensile_instability_plane",
    failure: "A stretched elastic block, its border held, is kicked in its middle and clumps from there, slowly at h = 1.8 \
              spacings. An artificial stress of 0.3 leaves no growing wave there; at h = 1.3, or in a fluid, it only slows them.",
    source: "Strand 2010, section 5.1; Swegle, Hicks & Attaway 1995; von Neumann's analysis of the discrete equations",
    plain: Side::new("elastic, h = 1.8 spacings", SQUARE).variant("elastic_h18").changes(|| set(&LONG)),
    remedy: Side::new("the same with artificial stress 0.3", SQUARE).variant("elastic_h18_eps03").changes(|| set(&LONG)),
    measure: GROWTH,
    fails: Bound::Above(1e3),
    survives: Bound::Below(1.5),
    trace: SPEED,
    small: &["duration=200e-6"],
};

const LONG: [&str; 2] = ["duration=400e-6", "output.series=4e-6"];

pub static SPACING: Row = Row {
    name: "artificial_stress_spacing",
    failure: "The artificial stress scales as (W(r)/W(d))^4. With d the mean distance to all neighbours, one reading of the \
              printed formula, that is thousands for the nearest ones, and the stretched row explodes sixty times faster than \
              without; with d the spacing of the lattice it is stable.",
    source: "Strand 2010, sections 3.3 and 5.1: both meanings of the spacing",
    plain: Side::new("d the mean distance to neighbours", SQUARE).variant("line_eps1045_mean"),
    remedy: Side::new("d the spacing", SQUARE).variant("line_eps1119"),
    measure: GROWTH,
    fails: Bound::Above(1e4),
    survives: Bound::Below(1.5),
    trace: SPEED,
    small: &[],
};

const REST_SCENE: Text = text!("src/study/atlas/rows/ball_at_rest.toml");

pub static REST: Row = Row {
    name: "artificial_stress_at_rest",
    failure: "The artificial stress on principal stresses is no gradient of an energy. A free ball at rest, barely touched, \
              loses its order all by itself; without artificial stress it comes to rest.",
    source: "this program's own runs of slow contact: scenes/two_balls.toml, variants slowest and slowest_bare",
    plain: Side::new("principal artificial stress 0.3", REST_SCENE),
    remedy: Side::new("no artificial stress", REST_SCENE).changes(|| set(&["formulation.artificial_stress=none"])),
    measure: Measure { about: "growth of disorder, 1e-6 a time unit", of: |run| run.result("growth").map(|rate| 1e6 * rate) },
    fails: Bound::Above(300.0),
    survives: Bound::Below(0.0),
    trace: Some(Trace { series: "disorder", about: "disorder in spacings", log: true }),
    small: &["duration=6000", "observe.growth.between=[3000, 6000]"],
};
