//! The scene's state under a part of its load: what is held is put where it belongs, what is free is found by
//! Newton's method, which follows an equilibrium beyond the load at which it is no longer stable.

use super::band::{Band, Factors};
use super::tangent::Pattern;
use crate::pass::{Call, Pass, Stage, force_scale, unbalanced};
use crate::rows::Clock;
use crate::scene::Scene;
use crate::state::State;
use crate::step;
use crate::tensor::{Real, Space};

/// Out-of-balance force over the stiffness of a particle, E V/h, at which Newton's method stops: rounding.
const BALANCED: f64 = 1e-13;
const MOST_ITERATIONS: usize = 40;

/// Component of a particle's displacement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unknown {
    pub particle: usize,
    pub axis: usize,
}

pub struct Path<S: Space> {
    pub state: State<S>,
    /// What is free, ordered along the longest axis.
    pub unknowns: Vec<Unknown>,
    pattern: Pattern,
    duration: f64,
    stiffness: f64,
}

impl<S: Space<Real = f64>> Path<S> {
    pub fn new(scene: &Scene, axis: usize) -> Self {
        let mut state = scene.state::<S>(false);
        state.clock = Clock { running: 1, rebuild: 1, ..Clock::default() };
        run(&mut state, &step::prepare(&scene.method));
        let mut order: Vec<usize> = (0..scene.particles.len()).collect();
        let place = |a: &usize| state.columns.reference_position[*a][axis];
        order.sort_by(|a, b| place(a).total_cmp(&place(b)));
        let free = |particle: usize, axis: usize| !held(&state, particle, axis);
        let unknowns: Vec<Unknown> = order
            .into_iter()
            .flat_map(|particle| (0..S::DIMENSION).map(move |axis| Unknown { particle, axis }))
            .filter(|u| free(u.particle, u.axis))
            .collect();
        let pattern = Pattern::new(&state, &unknowns);
        // At rest the scale is 1e-6 of the stiffness.
        let stiffness = (0..scene.particles.len()).map(|a| 1e6 * force_scale(&state, a)).fold(0.0, f64::max);
        Self { state, unknowns, pattern, duration: scene.file.duration, stiffness }
    }

    /// Out-of-balance force on each unknown.
    pub fn forces(&mut self) -> Vec<f64> {
        run(&mut self.state, &[Pass::Deform, Pass::BondForce].map(|pass| Call { pass, stage: Stage::default() }));
        let force = |u: &Unknown| self.state.mass(u.particle) * unbalanced(&self.state, u.particle)[u.axis];
        self.unknowns.iter().map(force).collect()
    }

    pub fn add(&mut self, increments: &[f64], factor: f64) {
        for (unknown, increment) in self.unknowns.iter().zip(increments) {
            self.state.columns.displacement[unknown.particle][unknown.axis] += factor * increment;
        }
    }

    /// Minus the derivative of the forces by the unknowns.
    pub fn tangent(&mut self) -> Band {
        let pattern = std::mem::take(&mut self.pattern);
        let band = pattern.tangent(self);
        self.pattern = pattern;
        band
    }

    /// Puts what is held where it belongs under a part of the load.
    fn hold(&mut self, part: f64) {
        let state = &mut self.state;
        (state.clock.start, state.clock.duration) = (0.0, part * self.duration);
        for particle in 0..state.columns.displacement.len() {
            for axis in (0..S::DIMENSION).filter(|&axis| held(state, particle, axis)).collect::<Vec<_>>() {
                let constraint = state.constraints[state.columns.constraint[particle] as usize - 1];
                let time = state.course_integral(&constraint, 0.0, state.clock.duration);
                state.columns.displacement[particle][axis] = [constraint.x, constraint.y, constraint.z][axis] * time;
            }
        }
    }

    /// Finds equilibrium under a part of the load from the present state; gives the factors of its tangent.
    ///
    /// # Errors
    /// One sentence, where Newton's method does not converge.
    pub fn go(&mut self, part: f64) -> Result<Factors, String> {
        self.hold(part);
        let mut factors = None;
        let mut before = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let forces = self.forces();
            let size = forces.iter().fold(0.0_f64, |most, f| most.max(f.abs())) / self.stiffness;
            if size <= BALANCED {
                return self.tangent().factor();
            }
            let slow = size > 0.1 * before;
            let at_hand = factors.take().filter(|_| !slow);
            let present = match at_hand {
                Some(present) => present,
                None => self.tangent().factor()?,
            };
            let increments = present.solve(forces);
            self.add(&increments, 1.0);
            (factors, before) = (Some(present), size);
        }
        Err(format!("Newton's method found no equilibrium at {part} of the load: take more load steps"))
    }
}

/// Whether a boundary condition prescribes a component.
fn held<S: Space>(state: &State<S>, particle: usize, axis: usize) -> bool {
    let number = state.columns.constraint.get(particle).copied().unwrap_or(0);
    number != 0 && state.constraints[number as usize - 1].prescribed >> axis & 1 == 1
}

fn run<S: Space>(state: &mut State<S>, calls: &[Call]) {
    calls.iter().for_each(|call| call.pass.run(state, call.stage));
}

/// Smallest difference that central differences take, of a length: what they cut off and what rounding leaves of a
/// force are then both about 1e-10 of the stiffness.
pub fn difference<R: Real>(smoothing_length: R) -> f64 {
    1e-5 * smoothing_length.f64()
}
