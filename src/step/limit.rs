//! The longest step of an integrator, from the passes that its step is made of.

use super::step;
use crate::method::{Integrator, Method};
use crate::pass::{Call, Pass};

/// By what an oscillator grows at most in one step.
pub fn amplification(method: &Method, integrator: Integrator, omega_step: f64) -> f64 {
    let method = Method { integrator, ..method.clone() };
    let calls = step(&method);
    let [[a, c], [b, d]] = [[1.0, 0.0], [0.0, 1.0]].map(|start| oscillate(&calls, start, omega_step));
    let (half_trace, determinant) = (0.5 * (a + d), a * d - b * c);
    let discriminant = half_trace * half_trace - determinant;
    if discriminant > 0.0 { half_trace.abs() + discriminant.sqrt() } else { determinant.sqrt() }
}

/// Largest omega dt up to which no oscillator grows; 0 if every one does.
pub fn longest_step(method: &Method, integrator: Integrator) -> f64 {
    // Rounding, and far less than the growth of a Runge-Kutta method at the first step looked at.
    let stable = |omega_step: f64| amplification(method, integrator, omega_step) <= 1.0 + 1e-12;
    let scanned = (1..).map(|k| 0.01 * f64::from(k)).find(|&omega_step| !stable(omega_step));
    let (mut low, mut high) = (scanned.unwrap_or(0.01) - 0.01, scanned.unwrap_or(0.01));
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if stable(middle) { low = middle } else { high = middle }
    }
    if low < 0.01 { 0.0 } else { low }
}

/// Position and velocity of x'' = -omega^2 x after a step; the velocity over omega, the time in steps.
fn oscillate(calls: &[Call], [mut x, mut v]: [f64; 2], omega: f64) -> [f64; 2] {
    let mut force = -omega * x;
    let (mut start, mut sum) = ([x, v], [0.0; 2]);
    for Call { pass, stage } in calls {
        match pass {
            Pass::BondForce | Pass::Force => force = -omega * x,
            Pass::Kick => v += stage.part * force,
            Pass::Drift => x += stage.part * omega * v,
            Pass::RungeKutta => {
                if stage.first {
                    (start, sum) = ([x, v], [0.0; 2]);
                }
                let rates = [omega * v, force];
                for k in 0..2 {
                    sum[k] += stage.weight * rates[k];
                }
                let next = |k: usize| start[k] + stage.of_sum * sum[k] + stage.of_rate * rates[k];
                (x, v) = (next(0), next(1));
            }
            _ => {}
        }
    }
    [x, v]
}
