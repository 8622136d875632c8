//! Spin that is lost.

use crate::study::atlas::side::{set, text};
use crate::study::atlas::{Bound, Measure, Outcome, Row, Side, Text, Trace};

const DISC: Text = text!("scenes/rotating_disc.toml");

fn share_left(run: &Outcome) -> Result<f64, String> {
    Ok(run.last("spin")? / run.first("spin")?)
}

const LEFT: Measure = Measure { about: "angular momentum left after a turn, over that at the start", of: share_left };

const SPIN: Option<Trace> = Some(Trace { series: "spin", about: "angular momentum", log: false });

pub static FILTER: Row = Row {
    name: "rotation_lost_to_xsph",
    failure: "XSPH moves particles with a velocity averaged over their neighbours. Used as the velocity itself, as it became in \
              Fuller's code, the average is a filter that stops a spinning disc within a turn; where particles only move with \
              it, pairs cancel and the spin stays.",
    source: "Fuller 2010, appendix A.4 and section 3.4; Monaghan 1989",
    plain: Side::new("average 0.5 as the velocity", DISC).changes(|| set(&["formulation.velocity_filter=0.5"])),
    remedy: Side::new("average 0.5 moves the particles alone", DISC).changes(|| set(&["formulation.xsph=0.5"])),
    measure: LEFT,
    fails: Bound::Below(0.05),
    survives: Bound::Above(0.999999),
    trace: SPIN,
    small: &[],
};

pub static GRADIENT: Row = Row {
    name: "rotation_lost_to_gradients",
    failure: "The uncorrected gradient sees too little spin at the rim. The stress there does not turn with the body, winds up \
              like a spring and drives the disc back. With the corrected gradient and the force adjoint to it the spin stays.",
    source: "Fuller 2010, appendix A.4 and section 3.4; Bonet & Lok 1999",
    plain: Side::new("uncorrected gradients", DISC).variant("plain"),
    remedy: Side::new("corrected gradients, adjoint force", DISC).changes(|| set(&["formulation.viscosity.alpha=1.0"])),
    measure: LEFT,
    fails: Bound::Below(0.5),
    survives: Bound::Above(0.999999),
    trace: SPIN,
    small: &[],
};
