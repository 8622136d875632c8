//! Bodies that break though nothing in their equations breaks.

use crate::study::atlas::side::text;
use crate::study::atlas::{Bound, Measure, Row, Side, Text};

const COLLISION: Text = text!("scenes/colliding_rings.toml");

pub static RINGS: Row = Row {
    name: "numerical_fracture",
    failure: "Two rubber rings collide. Where they are stretched, the tensile instability gathers particles until the gaps are \
              wider than the kernel: the rings break, and no law of fracture was named. In the Total Lagrangian formulation \
              they bounce whole.",
    source: "Gray, Monaghan & Swift 2001; Fuller 2010, appendix A.5 and section 3.5",
    plain: Side::new("Eulerian without artificial stress", COLLISION).variant("off"),
    remedy: Side::new("Total Lagrangian", COLLISION).variant("lagrangian"),
    measure: Measure { about: "most pieces of a ring", of: |run| Ok(run.most("pieces_left")?.max(run.most("pieces_right")?)) },
    fails: Bound::Above(2.5),
    survives: Bound::Below(1.5),
    trace: None,
    small: &["duration=650"],
};
