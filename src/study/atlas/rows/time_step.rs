//! Steps longer than an integrator bears, from the highest frequency of the discrete equations.

use super::measures::GROWTH;
use crate::smoothing::Smoothing;
use crate::study::atlas::side::text;
use crate::study::atlas::{Bound, Row, Side, Text, Trace};
use crate::study::von_neumann::{ArtificialStress, Equations, Gradient, Lattice, Medium, Waves as _, periodic_wave_vectors};

const LATTICE: Text = text!("src/study/atlas/rows/ringing_lattice.toml");

/// Particles a side of the scene's periodic box.
const SIDE: usize = 16;

/// Of the scene's lattice, by von Neumann's analysis.
fn largest_frequency(gradient: Gradient) -> f64 {
    let lattice = Lattice { dimension: 2, spacing: 1.0, smoothing: Smoothing::CubicSpline, smoothing_length: 1.3 };
    let medium = Medium::at_volume(1.0, 1.0, 1.0 / 1.2, 1.0 / 2.6);
    let equations = Equations::new(lattice, medium, ArtificialStress::None, gradient);
    equations.largest_frequency(&periodic_wave_vectors([SIDE, SIDE, 1], 1.0))
}

/// About so many rows a series.
const ROWS: u32 = 50;

/// So many steps of omega dt, with an integrator.
fn steps(integrator: &str, angle: f64, count: u32) -> Vec<String> {
    let gradient = if integrator == "pefrl" { Gradient::Adjoint } else { Gradient::Plain };
    let step = angle / largest_frequency(gradient);
    let [duration, series] = [count, count.div_ceil(ROWS)].map(|steps| f64::from(steps) * step);
    vec![
        format!("time.integrator={integrator}"),
        format!("time.step={step:?}"),
        format!("duration={duration:?}"),
        format!("output.series={series:?}"),
    ]
}

/// A row whose plain side oversteps.
const fn row(name: &'static str, [failure, source]: [&'static str; 2], plain: Side, remedy: Side) -> Row {
    let trace = Some(Trace { series: "speed", about: "rms speed", log: true });
    let (fails, survives) = (Bound::Above(1e4), Bound::Below(2.0));
    Row { name, failure, source, plain, remedy, measure: GROWTH, fails, survives, trace, small: &[] }
}

pub static LEAPFROG: Row = row(
    "time_step_of_leapfrog",
    [
        "Leapfrog is stable up to a step of 2 over the highest frequency of the discrete equations. 5 % above it the fastest \
         mode of a kicked lattice nearly doubles at each step; 5 % below it rings on for as long as one likes.",
        "von Neumann's analysis of the same equations: omega dt = 2",
    ],
    Side::new("leapfrog at 1.05 of the limit", LATTICE).changes(|| steps("leapfrog", 2.1, 60)),
    Side::new("leapfrog at 0.95 of the limit", LATTICE).changes(|| steps("leapfrog", 1.9, 1000)),
);

pub static SSP_RK3: Row = row(
    "time_step_of_ssp_rk3",
    [
        "The third-order Runge-Kutta method is stable up to omega dt = sqrt(3). 5 % above it the fastest mode grows by a \
         twentieth at each step; 5 % below it the method damps.",
        "|R(iz)|^2 = 1 - z^4/12 + z^6/36, z = omega dt",
    ],
    Side::new("ssp_rk3 at 1.05 of the limit", LATTICE).changes(|| steps("ssp_rk3", 1.05 * 3f64.sqrt(), 500)),
    Side::new("ssp_rk3 at 0.95 of the limit", LATTICE).changes(|| steps("ssp_rk3", 0.95 * 3f64.sqrt(), 1000)),
);

pub static RK4: Row = row(
    "time_step_of_rk4",
    [
        "The classical Runge-Kutta method is stable up to omega dt = sqrt(8). 5 % above it the fastest mode grows by two \
         fifths at each step; 5 % below it the method damps.",
        "|R(iz)|^2 = 1 - z^6/72 + z^8/576, z = omega dt",
    ],
    Side::new("rk4 at 1.05 of the limit", LATTICE).changes(|| steps("rk4", 1.05 * 8f64.sqrt(), 60)),
    Side::new("rk4 at 0.95 of the limit", LATTICE).changes(|| steps("rk4", 0.95 * 8f64.sqrt(), 1000)),
);

/// The symplectic fourth-order method's limit: Omelyan, Mryglod & Folk 2002.
const PEFRL_LIMIT: f64 = 2.990;

pub static PEFRL: Row = row(
    "time_step_of_pefrl",
    [
        "The symplectic method of fourth order is stable up to omega dt = 2.99. It needs forces of positions alone: here the \
         Total Lagrangian lattice without hourglass energy, whose equations for small waves are the Eulerian ones with \
         adjoint gradients.",
        "Omelyan, Mryglod & Folk 2002; the trace of the method's matrix reaches -2 at omega dt = 2.990",
    ],
    Side::new("pefrl at 1.05 of the limit", LATTICE).variant("lagrangian").changes(|| steps("pefrl", 1.05 * PEFRL_LIMIT, 100)),
    Side::new("pefrl at 0.95 of the limit", LATTICE).variant("lagrangian").changes(|| steps("pefrl", 0.95 * PEFRL_LIMIT, 1000)),
);

pub static RK2: Row = row(
    "no_stable_step_of_rk2",
    [
        "The second-order Runge-Kutta method has no stable step for what rings undamped: an amplitude grows by about \
         (omega dt)^4/8 a step, however small. The third-order SSP method damps at the same step.",
        "|R(iz)|^2 = 1 + z^4/4, z = omega dt",
    ],
    Side::new("rk2 at omega dt = 0.5", LATTICE).changes(|| steps("rk2", 0.5, 2000)),
    Side::new("ssp_rk3 at omega dt = 0.5", LATTICE).changes(|| steps("ssp_rk3", 0.5, 2000)),
);
