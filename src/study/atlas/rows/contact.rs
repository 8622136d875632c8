//! Contact that sticks, and contact whose forces have no energy.

use crate::study::atlas::side::{set, text};
use crate::study::atlas::{Bound, Measure, Row, Side, Text, Trace};

const BALLS: Text = text!("scenes/two_balls.toml");

pub static ADHESION: Row = Row {
    name: "adhesive_contact",
    failure: "A ball strikes another at a thousandth of the speed of sound. Met in the same kernel sums they are one body while \
              their kernels overlap: the sums pull as they part, and viscosity acts in them. A potential between surfaces only \
              pushes.",
    source: "Fuller 2010, appendix A.3 and section 3.3; 2D finite elements: 0.937 at U = 0.1, and slower discs ring less",
    plain: Side::new("contact through the kernel", BALLS)
        .variant("slow")
        .changes(|| set(&["formulation.artificial_stress=none", "formulation.xsph=none"])),
    remedy: Side::new("barrier between surfaces", BALLS).variant("barrier_slow"),
    measure: Measure { about: "coefficient of restitution", of: |run| run.result("restitution") },
    fails: Bound::Below(0.2),
    survives: Bound::Above(0.97),
    trace: Some(Trace { series: "speed_b", about: "speed of the struck ball", log: false }),
    small: &[],
};

pub static STEPS: Row = Row {
    name: "contact_of_steps",
    failure: "A disc strikes one of a fifth of its mass, particle against particle. On a lattice the disc's outermost rows are flat and \
              meet all at once: a seventh of the rebound is lost, at any spacing; equal masses hide it. Fitted to the disc, surfaces \
              meet where they are.",
    source: "2D finite elements of the two discs at 0.01 c: 0.936",
    plain: Side::new("square lattice", BALLS).variant("steps_02"),
    remedy: Side::new("fitted to the disc", BALLS).variant("fitted_02"),
    measure: Measure { about: "coefficient of restitution", of: |run| run.result("restitution") },
    fails: Bound::Below(0.85),
    survives: Bound::Above(0.92),
    trace: Some(Trace { series: "speed_b", about: "speed of the struck disc", log: false }),
    small: &[],
};

const DISCS: Text = text!("src/study/atlas/rows/discs.toml");

pub static ZONES: Row = Row {
    name: "contact_zones",
    failure: "Forces along estimated normals, which depend on a distance from particle to particle, are no gradient of an \
              energy. In a slow oblique collision they multiply it; forces that derive from an energy of the surfaces' gap \
              keep it.",
    source: "Fuller 2010, (4.2) and appendix A.6",
    plain: Side::new("zones along normals", DISCS).variant("zones"),
    remedy: Side::new("energy of the gap", DISCS).variant("potential"),
    measure: Measure {
        about: "energy at the end over that at the start",
        of: |run| Ok(run.last("total")? / run.first("total")?),
    },
    fails: Bound::Above(5.0),
    survives: Bound::Below(1.001),
    trace: Some(Trace { series: "total", about: "total energy", log: true }),
    small: &[],
};

const FASTER: &[&str] = &["body.a.velocity=[0.05, 0]", "body.b.velocity=[-0.05, 0]", "duration=60", "output.series=1"];

pub static NORMALS: Row = Row {
    name: "contact_along_normals",
    failure: "A gap measured between smoothed surfaces depends on where their facets are and how they are turned. A force along \
              the normals alone leaves out what the other dependences give: neither energy nor angular momentum is kept. The \
              whole derivative keeps both.",
    source: "the derivative of the energy in src/facet.rs, with and without its other terms",
    plain: Side::new("force along the normals", DISCS).variant("normals").changes(|| set(FASTER)),
    remedy: Side::new("derivative of the gap's energy", DISCS).variant("potential").changes(|| set(FASTER)),
    measure: Measure {
        about: "largest change of angular momentum, over itself",
        of: |run| Ok(run.drift("spin")? / run.first("spin")?),
    },
    fails: Bound::Above(5e-4),
    survives: Bound::Below(1e-10),
    trace: Some(Trace { series: "total", about: "total energy", log: false }),
    small: &[],
};
