//! The highest angular frequency of a Total Lagrangian body's particles, and from it the bound that a run's steps keep to.
//!
//! About a state of rest the acceleration is linear in the displacement, -M^-1 K u, and self-adjoint in the inner product of
//! the masses. Lanczos' iteration on it, with the run's own passes in f64, so that correction, hourglass forces, surfaces and
//! mirror planes are all in it, finds the largest eigenvalue from below within some thirty forces; the rate at which it
//! still rises is added. Bodies exchange no forces but by contact, which the bound on the step counts apart, and so one
//! force serves the iterations of all. Bodies that are tied count as one.

use crate::method::{Formulation, Method};
use crate::pass::Pass;
use crate::scene::Scene;
use crate::state::State;
use crate::step;
use crate::tensor::{Line, Plane, Real, Solid, Space};

/// Part of the integrator's limit up to which steps go: the stiffness may rise from one bound to the next, and a held step
/// may be above its bound by a twentieth.
const TRUSTED: f64 = 0.8;
/// Most forces of an iteration, and the rise of the eigenvalue over [`LATELY`] of them at which it ends.
const MOST: usize = 60;
const LATELY: usize = 5;
const SETTLED: f64 = 2e-3;
/// Displacement, in the smallest smoothing length, of the particle that moves most: small enough to be linear, and far above
/// rounding in f64.
const SMALL: f64 = 1e-6;

/// What bounds the steps of a member of a run.
pub struct Bound {
    /// Highest angular frequency of each body, 1/time; none where the method has no frequencies.
    frequencies: Vec<f64>,
    /// Step times angular frequency up to which the integrator is trusted; 0 if it has no limit.
    stable: f64,
}

/// Finds what bounds the steps; None where they have no such bound or the scene fixes them. Its tables are gone when it returns,
/// so that a run never holds both these and its own.
pub fn of(member: &Scene) -> Option<Bound> {
    let method = &member.method;
    if method.between || method.quasi_static.is_some() || !method.finite_strain() || member.file.time.step.is_some() {
        return None;
    }
    let stable = TRUSTED * step::longest_step(method, method.integrator);
    if !has_frequencies(method) || stable == 0.0 {
        return Some(Bound { frequencies: Vec::new(), stable: 0.0 });
    }
    Some(Bound { frequencies: of_bodies(member), stable })
}

/// The longest time step that a scene bears at rest, and what it is the limit of: where the scene fixes its steps, nothing else
/// keeps them below it. None where steps are found for equilibrium.
pub fn longest_step(scene: &Scene) -> Option<(f64, &'static str)> {
    let of_member = |member: &Scene| {
        let method = &member.method;
        let stable = step::longest_step(method, method.integrator);
        if has_frequencies(method) && stable > 0.0 {
            let highest = of_bodies(member).into_iter().fold(0.0, f64::max);
            return (stable / highest, "the integrator bears at the highest frequency of the bodies at rest");
        }
        let rate = |body: &crate::scene::SceneBody| body.material.sound_speed() / body.smoothing_length;
        (1.0 / member.bodies.iter().map(rate).fold(0.0, f64::max), "sound takes through a smoothing length")
    };
    if scene.file.quasi_static.is_some() {
        return None;
    }
    scene.groups().iter().map(of_member).min_by(|a, b| a.0.total_cmp(&b.0))
}

fn of_bodies(member: &Scene) -> Vec<f64> {
    match member.dimension() {
        1 => frequencies(&mut member.state::<Line<f64>>(false)),
        2 => frequencies(&mut member.state::<Plane<f64>>(false)),
        _ => frequencies(&mut member.state::<Solid<f64>>(false)),
    }
}

impl Bound {
    /// Gives a state the bound, and the step at rest that follows from it.
    pub fn give<S: Space>(&self, state: &mut State<S>) {
        let known = state.bodies.iter_mut().zip(&self.frequencies);
        known.for_each(|(body, &frequency)| body.frequency = S::Real::of(frequency));
        state.params.stable = S::Real::of(self.stable);
        state.params.rest_step = S::Real::of(at_rest(state));
    }
}

/// Whether forces are the gradient of an energy, so that the discrete equations have frequencies.
fn has_frequencies(method: &Method) -> bool {
    method.formulation == Formulation::TotalLagrangian
}

/// Time step of the bodies when unstressed. The same as `bound_time_step` finds from the tables.
fn at_rest<S: Space>(state: &State<S>) -> f64 {
    let (params, number) = (&state.params, |x: S::Real| x.f64());
    let damped = 1.0 + 0.6 * number(params.alpha);
    let rate = |body: &crate::rows::Body<S::Real>| {
        let waves = number(body.sound_speed) / number(body.smoothing_length);
        let stable = number(params.stable);
        let fastest = if stable > 0.0 { number(params.cfl) / stable * number(body.frequency) } else { 0.0 };
        damped * waves.max(fastest)
    };
    let waves = state.bodies.iter().map(rate).fold(0.0, f64::max);
    let contact = if state.method.facets() { number(params.contact_rate) } else { 0.0 };
    number(params.cfl) / (waves * waves + contact).sqrt()
}

/// Highest angular frequency (1/time) of each body, about the configuration that the state is in; 0 where a body has no
/// stiffness.
pub fn frequencies<S: Space<Real = f64>>(state: &mut State<S>) -> Vec<f64> {
    (state.clock.running, state.clock.rebuild) = (1, 1);
    for call in step::prepare(&state.method) {
        call.pass.run(state, call.stage);
    }
    about(state)
}

/// The same of a state whose lists and corrections are made.
pub fn about<S: Space<Real = f64>>(state: &mut State<S>) -> Vec<f64> {
    let probe = Probe::new(state);
    let mut lanczos: Vec<Lanczos> = vec![Lanczos::default(); state.bodies.len()];
    let count = state.params.count as usize;
    let mut last = vec![S::Vec::default(); count];
    let mut current: Vec<S::Vec> = (0..count).map(|a| random::<S>(state.columns.number[a])).collect();
    let norms = probe.inner(&current, &current);
    probe.scale(&mut current, |body| 1.0 / norms[body].sqrt());
    for round in 1..=MOST {
        let mut next = probe.force(state, &current);
        let diagonal = probe.inner(&next, &current);
        let before: Vec<f64> = lanczos.iter().map(|body| body.beside.last().copied().unwrap_or(0.0)).collect();
        for a in 0..count {
            let body = probe.body[a];
            next[a] += (current[a] * diagonal[body] + last[a] * before[body]) * -1.0;
        }
        let norms = probe.inner(&next, &next);
        for (k, body) in lanczos.iter_mut().enumerate() {
            body.add(diagonal[k], norms[k].sqrt());
        }
        if round > LATELY && lanczos.iter().all(Lanczos::settled) {
            break;
        }
        // A body that has no direction left has found all of its own.
        probe.scale(&mut next, |body| if norms[body] > 0.0 { 1.0 / norms[body].sqrt() } else { 0.0 });
        (last, current) = (current, next);
    }
    pieces(state).into_iter().map(|piece| lanczos[piece].frequency()).collect()
}

/// For each body the first of the bodies that it is tied to, directly or by others: these have their frequencies together.
fn pieces<S: Space>(state: &State<S>) -> Vec<usize> {
    let count = state.bodies.len();
    let mut piece: Vec<usize> = (0..count).collect();
    if state.method.tied {
        for (a, b) in (0..count).flat_map(|a| (0..a).map(move |b| (a, b))) {
            if state.coupling[a * count + b].f64() > 0.0 && piece[a] != piece[b] {
                let (kept, gone) = (piece[a].min(piece[b]), piece[a].max(piece[b]));
                piece.iter_mut().filter(|piece| **piece == gone).for_each(|piece| *piece = kept);
            }
        }
    }
    piece
}

/// Applies the stiffness over the mass to fields of displacement, by finite differences about a state.
struct Probe<S: Space> {
    place: Vec<S::Vec>,
    rest: Vec<S::Vec>,
    mass: Vec<f64>,
    body: Vec<usize>,
    bodies: usize,
    small: f64,
    calls: Vec<crate::pass::Call>,
}

impl<S: Space<Real = f64>> Probe<S> {
    fn new(state: &mut State<S>) -> Self {
        let count = state.params.count as usize;
        let pieces = pieces(state);
        let body = (0..count).map(|a| state.columns.body.get(a).map_or(0, |&body| pieces[body as usize])).collect();
        let mass = (0..count).map(|a| state.body(a).density * state.columns.reference_volume[a]).collect();
        let least = state.bodies.iter().map(|body| body.smoothing_length).fold(f64::INFINITY, f64::min);
        let inner = |call: &crate::pass::Call| matches!(call.pass, Pass::Deform | Pass::BondForce);
        let calls = step::step(&Method { integrator: crate::method::Integrator::Leapfrog, ..state.method.clone() });
        let calls = calls.into_iter().filter(inner).collect();
        let (place, bodies) = (state.columns.displacement.clone(), state.bodies.len());
        let mut probe = Self { place, rest: Vec::new(), mass, body, bodies, small: SMALL * least, calls };
        probe.rest = probe.acceleration(state);
        probe
    }

    fn acceleration(&self, state: &mut State<S>) -> Vec<S::Vec> {
        for call in &self.calls {
            call.pass.run(state, call.stage);
        }
        state.columns.acceleration.clone()
    }

    /// M^-1 K of a field.
    fn force(&self, state: &mut State<S>, field: &[S::Vec]) -> Vec<S::Vec> {
        let largest = field.iter().map(|&v| S::inner(v, v)).fold(0.0, f64::max).sqrt();
        let part = self.small / largest;
        for (slot, (&place, &v)) in state.columns.displacement.iter_mut().zip(self.place.iter().zip(field)) {
            *slot = place + v * part;
        }
        let moved = self.acceleration(state);
        state.columns.displacement.clone_from(&self.place);
        moved.iter().zip(&self.rest).map(|(&there, &here)| (here - there) * (1.0 / part)).collect()
    }

    /// Inner product of two fields with the masses, for each body.
    fn inner(&self, left: &[S::Vec], right: &[S::Vec]) -> Vec<f64> {
        let mut sums = vec![0.0; self.bodies];
        for (a, &body) in self.body.iter().enumerate() {
            sums[body] += self.mass[a] * S::inner(left[a], right[a]);
        }
        sums
    }

    fn scale(&self, field: &mut [S::Vec], by: impl Fn(usize) -> f64) {
        field.iter_mut().zip(&self.body).for_each(|(v, &body)| *v = *v * by(body));
    }
}

/// A field without order: every wave has a part in it, the shortest most.
fn random<S: Space<Real = f64>>(number: u32) -> S::Vec {
    let component = |axis: u64| {
        // Mixing of splitmix64.
        let mut x = (3 * u64::from(number) + axis + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    S::vec_from([component(0), component(1), component(2)])
}

/// The tridiagonal matrix of an iteration.
#[derive(Debug, Clone, Default)]
struct Lanczos {
    diagonal: Vec<f64>,
    beside: Vec<f64>,
    /// Its largest eigenvalue after each round.
    found: Vec<f64>,
}

impl Lanczos {
    fn add(&mut self, diagonal: f64, beside: f64) {
        self.diagonal.push(diagonal);
        self.found.push(self.largest());
        self.beside.push(beside);
    }

    /// Largest eigenvalue, by bisection: below x lie as many as the factors of the matrix less x that are negative.
    fn largest(&self) -> f64 {
        let count = self.diagonal.len();
        let beside = |k: usize| if k < self.beside.len() && k + 1 < count { self.beside[k].abs() } else { 0.0 };
        let edge = |k: usize| self.diagonal[k] + beside(k) + if k > 0 { beside(k - 1) } else { 0.0 };
        let mut high = (0..count).map(edge).fold(0.0, f64::max);
        let mut low = 0.0;
        let all_below = |x: f64| {
            let mut factor = 1.0;
            (0..count).all(|k| {
                let before = if k > 0 { beside(k - 1) } else { 0.0 };
                factor = self.diagonal[k] - x - before * before / factor;
                factor < 0.0
            })
        };
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if all_below(middle) { high = middle } else { low = middle }
        }
        high
    }

    fn rise(&self) -> f64 {
        let Some(&last) = self.found.last() else { return 0.0 };
        last - self.found[self.found.len().saturating_sub(1 + LATELY)]
    }

    fn settled(&self) -> bool {
        self.rise() <= SETTLED * self.found.last().copied().unwrap_or(0.0)
    }

    fn frequency(&self) -> f64 {
        // What is still missing is of the size of what came last.
        (self.found.last().copied().unwrap_or(0.0) + self.rise()).sqrt()
    }
}
