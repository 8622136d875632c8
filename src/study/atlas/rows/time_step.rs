//! Steps longer than an integrator bears, from the highest frequency of the discrete equations.

use super::GROWTH;
use crate::smoothing::Smoothing;
use crate::study::atlas::side::text;
use crate::study::atlas::{Bound, Row, Side, Text, Trace};
use crate::study::von_neumann::{ArtificialStress, Equations, Gradient, Lattice, Medium, Waves as _, periodic_wave_vectors};

const LATTICE: Text = text!("src/study/atlas/rows/ringing_lattice.toml");

/// Particles a side of the scene's periodic box.
const SIDE: usize = 16;

/// Of the scene's lattice, by von Neumann's analysis.
fn largest_frequency() -> f64 {
    let lattice = Lattice { dimension: 2, spacing: 1.0, smoothing: Smoothing::CubicSpline, smoothing_length: 1.3 };
    let medium = Medium::at_volume(1.0, 1.0, 1.0 / 1.2, 1.0 / 2.6);
    let equations = Equations::new(lattice, medium, ArtificialStress::None, Gradient::Plain);
    equations.largest_frequency(&periodic_wave_vectors([SIDE, SIDE, 1], 1.0))
}

/// About so many rows a series.
const ROWS: u32 = 50;

/// So many steps of omega dt, with an integrator.
fn steps(integrator: &str, angle: f64, count: u32) -> Vec<String> {
    let step = angle / largest_frequency();
    let [duration, series] = [count, count.div_ceil(ROWS)].map(|steps| f64::from(steps) * step);
    vec![
        format!("time.integrator={integrator}"),
        format!("time.step={step:?}"),
        format!("duration={duration:?}"),
        format!("output.series={series:?}"),
    ]
}

const SPEED: Option<Trace> = Some(Trace { series: "speed", about: "rms speed", log: true });

pub static LEAPFROG: Row = Row {
    name: "time_step_past_its_limit",
    failure: "Leapfrog is stable up to a step of 2 over the highest frequency of the discrete equations. 5 % above it the \
              fastest mode of a kicked lattice nearly doubles at each step; 5 % below it rings on for as long as one likes.",
    source: "von Neumann's analysis of the same equations: omega dt = 2",
    plain: Side::new("leapfrog at 1.05 of the limit", LATTICE).changes(|| steps("leapfrog", 2.1, 60)),
    remedy: Side::new("leapfrog at 0.95 of the limit", LATTICE).changes(|| steps("leapfrog", 1.9, 1000)),
    measure: GROWTH,
    fails: Bound::Above(1e4),
    survives: Bound::Below(2.0),
    trace: SPEED,
    small: &[],
};

pub static RK2: Row = Row {
    name: "no_stable_step_of_rk2",
    failure: "The second-order Runge-Kutta method has no stable step for what rings undamped: an amplitude grows by about \
              (omega dt)^4/8 a step, however small. The third-order SSP method damps at the same step.",
    source: "|1 + iz - z^2/2|^2 = 1 + z^4/4, z = omega dt",
    plain: Side::new("rk2 at omega dt = 0.5", LATTICE).changes(|| steps("rk2", 0.5, 2000)),
    remedy: Side::new("ssp_rk3 at omega dt = 0.5", LATTICE).changes(|| steps("ssp_rk3", 0.5, 2000)),
    measure: GROWTH,
    fails: Bound::Above(1e4),
    survives: Bound::Below(2.0),
    trace: SPEED,
    small: &[],
};
