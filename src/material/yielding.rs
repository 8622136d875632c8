//! The one return to the yield surface, in both formulations, for every strength that yields: the Mises stress
//! q = sqrt(3/2)|S| is brought down to what the strength bears at the plastic strain, its rate and the temperature that
//! the flow itself makes. Twin: shaders/lib/yielding.wgsl
//!
//! At finite strain, elasticity is that of [`super::inelastic`] with C_i = C_p: a body that relaxes only as far as yield
//! asks. The associated flow d_p = (3/2) (tau^D/q) k' is dC_p/dt = (3 mu/q) k' X^D C_p, so a step ends at the unimodular
//! part of C_p + w C', and the weight w is found from q. Nothing here turns with the body, and det C_p stays 1.

use super::inelastic::{Mixed, over, relaxed, whole};
use super::point::{Flow, Memory, Point};
use super::strain::{cube_root_change, lacking, unimodular_strain};
use super::{flow, rise};
use crate::rows::Body;
use crate::tensor::{Real, Space};

/// Rounds of Newton's method in [`increment`] at most; most laws take three.
const ROUNDS: usize = 24;
/// Rounds that bring the Mises stress q to the flow stress sY at finite strain. Each round multiplies the error by about the
/// elastic strain of the trial state, which is small where a metal yields; where strains or rates are large more rounds follow,
/// until the two agree.
const FINITE_ROUNDS: [usize; 2] = [5, 40];
/// Error of a flow stress that counts as rounding, in units of the distance from one floating-point number to the next.
const ROUNDING: f64 = 4.0;
/// Part of the highest possible growth that is tried next where Newton's method has left its bounds and no lower bound is
/// known yet.
const PART: f64 = 1e-3;

/// The state at the end of a step in which nothing has flowed yet.
struct Trial<R> {
    /// Mises stress if nothing flowed.
    stress: R,
    strain: R,
    temperature: R,
    /// By how much the trial stress falls for each unit of growth of the plastic strain, 3 mu.
    stiffness: R,
    /// Time that the step takes.
    step: R,
    /// Volume over reference volume, by which work per volume becomes work per reference volume.
    volume: R,
}

impl<R: Real> Trial<R> {
    /// The point at which the strength is asked after a growth of the plastic strain, over which the flow stress goes from
    /// `begin` to `end`. The temperature rises by the heat of the plastic work, the mean of the two times the growth.
    #[inline(always)]
    fn point(&self, body: &Body<R>, growth: R, begin: R, end: R) -> Point<R> {
        Point {
            strain: self.strain + growth,
            rate: self.rate(growth),
            temperature: self.temperature + rise(body, R::of(0.5) * (begin + end) * growth * self.volume),
        }
    }
    #[inline(always)]
    fn rate(&self, growth: R) -> R {
        if self.step > R::of(0.0) { growth / self.step } else { R::of(0.0) }
    }
    /// Derivative of the flow stress by the growth.
    #[inline(always)]
    fn slope(&self, flow: &Flow<R>) -> R {
        if self.step > R::of(0.0) { flow.by_strain + flow.by_rate / self.step } else { flow.by_strain }
    }
    /// Flow stress before the step, at rest.
    #[inline(always)]
    fn at_rest(&self, body: &Body<R>) -> Flow<R> {
        flow(body, &Point { strain: self.strain, rate: R::of(0.0), temperature: self.temperature })
    }
    /// Flow stress where the step begins, at its own rate.
    #[inline(always)]
    fn begin(&self, body: &Body<R>, growth: R) -> R {
        flow(body, &Point { strain: self.strain, rate: self.rate(growth), temperature: self.temperature }).stress
    }
}

/// Growth d of the equivalent plastic strain by which the flow stress meets a Mises stress that falls with it:
/// trial - stiffness d = sY(k + d, d/step, T(d)). The trial stress is above that at rest.
///
/// Newton's method in ln d, in which a power of the strain or of its rate is straight or convex, between bounds that
/// close in: in d itself it would crawl where a small power rules.
#[inline(always)]
fn increment<R: Real>(body: &Body<R>, trial: &Trial<R>, rest: &Flow<R>) -> R {
    let (zero, stiffness) = (R::of(0.0), trial.stiffness);
    let (mut low, mut high) = (zero, (trial.stress - rest.stress) / stiffness);
    let mut d = (trial.stress - rest.stress) / (stiffness + rest.by_strain);
    for _ in 0..ROUNDS {
        let begin = trial.begin(body, d);
        let at = flow(body, &trial.point(body, d, begin, trial.stress - stiffness * d));
        let excess = trial.stress - stiffness * d - at.stress;
        if excess.abs() <= R::of(ROUNDING * R::EPSILON) * trial.stress {
            break;
        }
        if excess > zero {
            low = d;
        } else {
            high = d;
        }
        let power = excess / ((stiffness + trial.slope(&at)) * d);
        d = d * power.min(R::of(80.0)).exp();
        if d <= low || d >= high {
            d = if low > zero { (low * high).sqrt() } else { high * R::of(PART) };
        }
    }
    d
}

/// sqrt(3 J2) of a deviator, the components on axes that the dimension lacks included.
pub fn mises<S: Space>(deviator: S::Sym) -> S::Real {
    let within = S::mat_of_sym(deviator);
    let rest = S::sym_trace(deviator);
    let across = if S::DIMENSION == 3 { S::Real::of(0.0) } else { rest * rest / lacking::<S>() };
    (S::Real::of(1.5) * (S::trace(S::mat_mat(within, within)) + across)).sqrt()
}

/// State of a particle of the Eulerian formulation after a step.
#[derive(Debug, Clone, Copy, Default)]
pub struct Yielded<Sym, R> {
    pub deviator: Sym,
    /// Growth of the equivalent plastic strain.
    pub growth: R,
    /// Plastic work per reference volume: the mean of the flow stress at the step's start and end times the growth of k. The
    /// motion's work is counted by the same rule, so that energies add up.
    pub work: R,
}

/// The state of a particle before the step.
#[derive(Debug, Clone, Copy)]
pub struct Before<R> {
    /// Equivalent plastic strain.
    pub strain: R,
    pub temperature: R,
    /// Volume over reference volume.
    pub volume: R,
}

/// Eulerian: the deviator returned along itself to the yield surface.
pub fn yielded<S: Space>(
    body: &Body<S::Real>,
    deviator: S::Sym,
    before: Before<S::Real>,
    step: S::Real,
) -> Yielded<S::Sym, S::Real> {
    let zero = S::Real::of(0.0);
    let none = Yielded { deviator, growth: zero, work: zero };
    if body.yield_stress == zero {
        return none;
    }
    let stiffness = S::Real::of(3.0) * body.shear_modulus;
    let Before { strain, temperature, volume } = before;
    let trial = Trial { stress: mises::<S>(deviator), strain, temperature, stiffness, step, volume };
    let rest = trial.at_rest(body);
    if trial.stress <= rest.stress {
        return none;
    }
    let growth = increment(body, &trial, &rest);
    let lost = stiffness * growth;
    let work = S::Real::of(0.5) * (trial.begin(body, growth) + trial.stress - lost) * growth * volume;
    Yielded { deviator: deviator * (S::Real::of(1.0) - lost / trial.stress), growth, work }
}

/// The invariants of A = C_p C'^-1 = b_e^-1 that the Mises stress needs, of first, second and third order in strain.
struct Invariants<R> {
    /// tr A/3
    mean: R,
    /// tr A^D A^D
    square: R,
    /// det A^D
    cube: R,
}

impl<R: Real> Invariants<R> {
    fn of<S: Space<Real = R>>(strain: Mixed<S>) -> Self {
        let deviator = strain.deviator();
        Self {
            mean: R::of(1.0) + strain.trace() * R::of(1.0 / 3.0),
            square: deviator.inner(deviator),
            cube: deviator.determinant(),
        }
    }

    /// q/mu and rho of b_e = rho (A + w)^-1, rho^3 = det(A + w). With m = mean + w, the deviator of the inverse is
    /// (-m D + D D - D:D/3)/det: no sum here is of numbers near 1, or cancels.
    fn mises(&self, w: R) -> (R, R) {
        let m = self.mean + w;
        let part = (self.cube / m - R::of(0.5) * self.square) / (m * m);
        let rho = m * (R::of(1.0) + cube_root_change(part));
        let norm = self.square * (m * m + self.square * R::of(1.0 / 6.0)) - R::of(6.0) * m * self.cube;
        ((R::of(1.5) * norm.max(R::of(0.0))).sqrt() / (rho * rho), rho)
    }
}

/// At finite strain: the memory after a step that ends at H.
///
/// At fixed H the flow follows A(w) = (A + w)/rho with dk = q/(3 mu rho) dw. The step takes the geometric mean of the
/// integrand's ends, which is exact for small strains: there q falls as 1/(1 + w) and by 3 mu dk, and the step is the
/// radial return. Each round corrects w by the step that would be exact if strains were small.
pub fn relax<S: Space>(body: &Body<S::Real>, h: S::Mat, memory: Memory<S>, step: S::Real) -> Memory<S> {
    if body.yield_stress == S::Real::of(0.0) {
        return memory;
    }
    let (mu, one) = (body.shear_modulus, S::Real::of(1.0));
    let (total, plastic) = (unimodular_strain::<S>(h), whole::<S>(memory.strain));
    let invariants = Invariants::of(over::<S>(plastic, total, total));
    let stiffness = S::Real::of(3.0) * mu;
    let trial = Trial {
        stress: mu * invariants.mises(S::Real::of(0.0)).0,
        strain: memory.plastic,
        temperature: memory.temperature,
        stiffness,
        step,
        volume: one,
    };
    let rest = trial.at_rest(body);
    if trial.stress <= rest.stress {
        return memory;
    }
    let mut growth = increment(body, &trial, &rest);
    let mut w = stiffness * growth / (trial.stress - stiffness * growth);
    let mut at = Point { strain: trial.strain, rate: trial.rate(growth), temperature: trial.temperature };
    // q falls with w and the flow stress grows: the root lies between the largest w that was too small and the smallest that was
    // too large, infinite until one is known.
    let (mut low, mut high) = (S::Real::of(0.0), S::Real::of(f64::INFINITY));
    for round in 1..=FINITE_ROUNDS[1] {
        let (ratio, rho) = invariants.mises(w);
        let q = mu * ratio;
        growth = w * (trial.stress * q / rho).sqrt() / stiffness;
        at = trial.point(body, growth, trial.begin(body, growth), q);
        let wanted = flow(body, &at);
        let excess = (q - wanted.stress) * stiffness / (stiffness + trial.slope(&wanted));
        if q > wanted.stress {
            low = w;
        } else {
            high = w;
        }
        w += (one + w) * excess / (q - excess);
        if w < low || w > high {
            w = S::Real::of(0.5) * (low + high);
        }
        if round >= FINITE_ROUNDS[0] && (q - wanted.stress).abs() <= S::Real::of(ROUNDING * S::Real::EPSILON) * q {
            break;
        }
    }
    Memory { strain: relaxed::<S>(h, memory.strain, w), plastic: memory.plastic + growth, temperature: at.temperature }
}
