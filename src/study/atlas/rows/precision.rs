//! What 24 bits do not hold.

use crate::study::atlas::side::text;
use crate::study::atlas::{Bound, Machine, Measure, Outcome, Row, Side, Text, Trace};

const BRAKED: Text = text!("src/study/atlas/rows/braked_block.toml");

/// Distance of the speed lost from force times time, over that.
fn braking_missed(run: &Outcome) -> Result<f64, String> {
    let force = run.scene.file.body_force.as_ref().ok_or("the scene has no body force")?[0];
    let lost = run.last("speed")? - run.first("speed")?;
    Ok((lost / (force * run.scene.file.duration) - 1.0).abs())
}

pub static STAGNATION: Row = Row {
    name: "stagnation_in_f32",
    failure: "In f32 a small change added to a large number is rounded away: a block that a small force brakes never slows \
              down, and a slow drift far from the start never moves. Sums that carry what they dropped find all of it.",
    source: "Kahan 1965; tests/backend/precision.rs shows the same of positions",
    plain: Side::new("f32, plain sums", BRAKED).machine(Machine::SingleBare),
    remedy: Side::new("f32, compensated sums", BRAKED).machine(Machine::Single),
    measure: Measure { about: "braking that is missed, over all of it", of: braking_missed },
    fails: Bound::Above(0.9),
    survives: Bound::Below(0.01),
    trace: Some(Trace { series: "speed", about: "speed", log: false }),
    small: &[],
};

const TRAVELLING: Text = text!("src/study/atlas/rows/travelling_bar.toml");

/// Kinetic energy at the start of the wave alone: mass times half the mean square of its speed.
const RINGING: f64 = 320.0 * 0.5 * 0.5e-8;

pub static DIGITS: Row = Row {
    name: "digits_lost_in_f32",
    failure: "Strain is a difference of displacements. In f32 a bar that has travelled a thousand of its lengths has no digits \
              left for strains of 1e-4: they are noise, and the noise heats it. f64 keeps them. (In f32 a frame that travels \
              with the bar would.)",
    source: "rounding: 6e-8 of a displacement of 40000 is 2e-3 spacings",
    plain: Side::new("f32", TRAVELLING).machine(Machine::Single),
    remedy: Side::new("f64", TRAVELLING),
    measure: Measure {
        about: "largest elastic energy over the energy of the ringing",
        of: |run| Ok(run.most("elastic")? / RINGING),
    },
    fails: Bound::Above(100.0),
    survives: Bound::Below(1.05),
    trace: Some(Trace { series: "elastic", about: "elastic energy", log: true }),
    small: &[],
};
