//! Shape functions of Liu's fully corrected kernel, Shutov & Klyuchantsev 2019 (1) to (3):
//!
//! psi_b(x) = alpha(x) (1 + beta(x) . r) W(r), r = x - x_b; sum V_b psi_b = 1 and sum V_b psi_b r = 0.
//!
//! With the sums m = sum V_b W, p = sum V_b W r and M = sum V_b W r (x) r:
//! beta = -M^-1 p and alpha = 1/(m + beta . p). Their derivatives are found by differentiating M beta = -p and
//! 1/alpha, in place of the paper's finite difference (4): with W' r/|r| for the gradient of W,
//! s = sum V_b (W'/r) (1 + beta . r) r and G = sum V_b (W'/r) (1 + beta . r) r (x) r,
//!
//! d beta/dx = -M^-1 (G + 1/alpha + p (x) beta), d alpha/dx = -alpha^2 (s + (d beta/dx)^T p + m beta).
//!
//! The particle at x is one of the b. Twin: shaders/lib/shape.wgsl, shape_node.wgsl and shape_columns.wgsl

use crate::pair::{inverse_or, mirror_vector, pair_coupling, reference_separation, separation};
use crate::rows::{NEIGHBOR_BITS, NEIGHBOR_MASK};
use crate::smoothing::Scaled;
use crate::state::State;
use crate::tensor::{Real, Space};

/// A particle whose shape function does not vanish where particle a is, a itself among them.
#[derive(Clone, Copy)]
pub struct Node<S: Space> {
    pub b: usize,
    /// Planes that it is mirrored in, one bit each.
    pub image: u32,
    /// x_a - x_b
    pub x: S::Vec,
    /// Weight of sums between the two bodies.
    pub coupled: S::Real,
    /// V_b times that weight.
    pub volume: S::Real,
    /// W
    pub weight: S::Real,
    /// W'/r
    pub slope: S::Real,
}

/// Correction of the kernel at a point.
#[derive(Clone, Copy)]
pub struct Shape<S: Space> {
    /// alpha
    pub factor: S::Real,
    /// beta
    pub slope: S::Vec,
    pub factor_gradient: S::Vec,
    /// Component (i, j): d beta_i/dx_j
    pub slope_gradient: S::Mat,
}

/// The nodes of particle a, of which the last is a itself; with `reference` those of the reference configuration.
#[inline(always)]
pub fn nodes<S: Space>(state: &State<S>, a: usize, reference: bool) -> impl Iterator<Item = Node<S>> {
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let entries = state.neighbors_of(a).iter().copied().chain(std::iter::once(a as u32));
    entries.map(move |entry| {
        let (b, image) = ((entry & NEIGHBOR_MASK) as usize, entry >> NEIGHBOR_BITS);
        let x = if reference { reference_separation(state, a, entry) } else { separation(state, a, entry) };
        let mut h = state.smoothing_length(a);
        if state.method.many_bodies {
            h = S::Real::of(0.5) * (h + state.smoothing_length(b));
        }
        let distance = S::inner(x, x).sqrt();
        let (weight, slope) = (kernel.weight(distance, h), kernel.gradient(distance, h));
        let coupled = pair_coupling(state, a, b);
        Node { b, image, x, coupled, volume: volume(state, b, reference) * coupled, weight, slope }
    })
}

#[inline(always)]
fn volume<S: Space>(state: &State<S>, b: usize, reference: bool) -> S::Real {
    if reference { state.columns.reference_volume[b] } else { state.volume(b) }
}

/// m, p and M; s and G.
struct Moments<S: Space> {
    zeroth: S::Real,
    first: S::Vec,
    second: S::Mat,
}

/// The correction where particle a is.
#[inline(always)]
pub fn correct<S: Space>(state: &State<S>, a: usize, reference: bool) -> Shape<S> {
    let one = S::Real::of(1.0);
    let mut of_kernel = Moments::<S> { zeroth: S::Real::of(0.0), first: S::Vec::default(), second: S::Mat::default() };
    for node in nodes(state, a, reference) {
        let share = node.volume * node.weight;
        of_kernel.zeroth += share;
        of_kernel.first += node.x * share;
        of_kernel.second += S::outer(node.x, node.x * share);
    }
    let inverse = inverse_or_zero::<S>(of_kernel.second, state.smoothing_length(a));
    let slope = S::mat_vec(inverse, of_kernel.first) * -one;
    let (mut first, mut second) = (S::Vec::default(), S::Mat::default());
    for node in nodes(state, a, reference) {
        let share = node.volume * node.slope * (one + S::inner(slope, node.x));
        first += node.x * share;
        second += S::outer(node.x, node.x * share);
    }
    differentiate::<S>(&of_kernel, slope, inverse, (first, second))
}

#[inline(always)]
fn differentiate<S: Space>(of: &Moments<S>, slope: S::Vec, inverse: S::Mat, of_gradient: (S::Vec, S::Mat)) -> Shape<S> {
    let one = S::Real::of(1.0);
    let total = of.zeroth + S::inner(slope, of.first);
    let factor = one / total;
    let change = of_gradient.1 + S::mat_identity() * total + S::outer(of.first, slope);
    let slope_gradient = S::mat_mat(inverse, change) * -one;
    let change = of_gradient.0 + S::mat_vec(S::transpose(slope_gradient), of.first) + slope * of.zeroth;
    Shape { factor, slope, factor_gradient: change * -(factor * factor), slope_gradient }
}

/// M^-1; zero where the particles around lie on a line or a plane, or there are none: then alpha alone corrects.
#[inline(always)]
fn inverse_or_zero<S: Space>(moment: S::Mat, h: S::Real) -> S::Mat {
    // In units of h, so that f32 holds the determinant of the smallest scene.
    let scale = S::Real::of(1.0) / (h * h);
    inverse_or::<S>(moment * scale, S::Mat::default()) * scale
}

impl<S: Space> Shape<S> {
    /// The bare kernel.
    #[inline(always)]
    pub fn bare() -> Self {
        Self {
            factor: S::Real::of(1.0),
            slope: S::Vec::default(),
            factor_gradient: S::Vec::default(),
            slope_gradient: S::Mat::default(),
        }
    }
    /// The correction of particle a, as it was last made.
    #[inline(always)]
    pub fn of(state: &State<S>, a: usize) -> Self {
        if !state.method.corrected_kernel.is_some_and(|options| options.correction) {
            return Self::bare();
        }
        let p = &state.columns;
        Self {
            factor: p.shape_factor[a],
            slope: p.shape_slope[a],
            factor_gradient: p.shape_factor_gradient[a],
            slope_gradient: p.shape_slope_gradient[a],
        }
    }
    /// psi_b here, x from b to here.
    #[inline(always)]
    pub fn value(&self, x: S::Vec, weight: S::Real) -> S::Real {
        self.factor * (S::Real::of(1.0) + S::inner(self.slope, x)) * weight
    }
    /// Gradient of psi_b here, x from b to here.
    #[inline(always)]
    pub fn gradient(&self, x: S::Vec, weight: S::Real, slope: S::Real) -> S::Vec {
        let tilt = S::Real::of(1.0) + S::inner(self.slope, x);
        let turned = S::mat_vec(S::transpose(self.slope_gradient), x) + self.slope;
        x * (self.factor * tilt * slope) + self.factor_gradient * (weight * tilt) + turned * (self.factor * weight)
    }
}

/// A neighbour's vector, mirrored if it is an image.
#[inline(always)]
pub fn seen<S: Space>(state: &State<S>, image: u32, v: S::Vec) -> S::Vec {
    if image == 0 { v } else { mirror_vector::<S>(&state.params, image, v) }
}
