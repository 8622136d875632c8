//! What the loops over neighbours share: separation, mirror images, kernel gradient.
//! Twin: shaders/lib/pair.wgsl

use crate::rows::{NEIGHBOR_BITS, NEIGHBOR_MASK, Params};
use crate::smoothing::{LANES, Scaled};
use crate::state::State;
use crate::tensor::{Real, Space};

/// A neighbour as particle a sees it.
#[derive(Clone, Copy)]
pub struct Pair<S: Space> {
    pub b: usize,
    /// Planes that the neighbour is mirrored in, one bit each.
    pub image: u32,
    /// x_a - x_b
    pub x: S::Vec,
    pub distance: S::Real,
    /// Mean smoothing length of the two.
    pub h: S::Real,
    /// (dW/dr)/r: times x it is the gradient of W at a.
    pub gradient: S::Real,
}

/// Normal of a mirror plane.
#[inline(always)]
fn normal<S: Space>(plane: &[S::Real; 4]) -> S::Vec {
    let mut n = S::Vec::default();
    for k in 0..S::DIMENSION {
        n[k] = plane[k];
    }
    n
}

// Few pairs cross a mirror plane: kept out of line, so that the pair loops stay small enough to optimise.

/// Mirrors a vector, a velocity or displacement, in each plane of the mask.
#[cold]
#[inline(never)]
pub fn mirror_vector<S: Space>(params: &Params<S::Real>, image: u32, mut v: S::Vec) -> S::Vec {
    for (k, plane) in params.planes.iter().enumerate() {
        if image >> k & 1 == 1 {
            let n = normal::<S>(plane);
            v = v - n * (S::Real::of(2.0) * S::inner(v, n));
        }
    }
    v
}

/// Mirrors a point in each plane of the mask.
#[cold]
#[inline(never)]
pub fn mirror_point<S: Space>(params: &Params<S::Real>, image: u32, mut x: S::Vec) -> S::Vec {
    for (k, plane) in params.planes.iter().enumerate() {
        if image >> k & 1 == 1 {
            let n = normal::<S>(plane);
            x = x - n * (S::Real::of(2.0) * (S::inner(x, n) - plane[3]));
        }
    }
    x
}

/// Mirrors a tensor: H M H with H = 1 - 2 n (x) n.
#[cold]
#[inline(never)]
pub fn mirror_tensor<S: Space>(params: &Params<S::Real>, image: u32, mut m: S::Mat) -> S::Mat {
    for (k, plane) in params.planes.iter().enumerate() {
        if image >> k & 1 == 1 {
            let n = normal::<S>(plane);
            let h = S::mat_identity() - S::outer(n, n) * S::Real::of(2.0);
            m = S::mat_mat(h, S::mat_mat(m, h));
        }
    }
    m
}

/// Shortens a separation to the nearest periodic image.
#[inline(always)]
fn nearest_image<S: Space>(params: &Params<S::Real>, mut x: S::Vec) -> S::Vec {
    let period = [params.period_x, params.period_y, params.period_z];
    for k in 0..S::DIMENSION {
        if period[k] > S::Real::of(0.0) {
            x[k] = x[k] - period[k] * (x[k] / period[k]).round();
        }
    }
    x
}

/// x_a - x_b from reference positions and displacements apart, so that f32 keeps the small difference.
#[inline(always)]
pub fn separation<S: Space>(state: &State<S>, a: usize, entry: u32) -> S::Vec {
    let (b, image) = ((entry & NEIGHBOR_MASK) as usize, entry >> NEIGHBOR_BITS);
    let columns = &state.columns;
    let (mut reference, mut displacement) = (columns.reference_position[b], columns.displacement[b]);
    if image != 0 {
        reference = mirror_point::<S>(&state.params, image, reference);
        displacement = mirror_vector::<S>(&state.params, image, displacement);
    }
    let x = (columns.reference_position[a] - reference) + (columns.displacement[a] - displacement);
    if state.method.periodic { nearest_image::<S>(&state.params, x) } else { x }
}

/// Up to [`LANES`] neighbours of one particle, their kernel gradients evaluated together.
pub struct Block<S: Space> {
    count: usize,
    entry: [u32; LANES],
    x: [S::Vec; LANES],
    distance: [S::Real; LANES],
    h: [S::Real; LANES],
    gradient: [S::Real; LANES],
}

/// The neighbours of particle a within the kernel's support, in the order of its list, as blocks:
/// `for block in blocks(state, a) { for pair in block.pairs() { … } }`.
///
/// Two plain loops, because a visitor passed as a closure is not inlined once its body is large. A list reaches
/// beyond the support (on a cubic lattice with h = 1.22 spacings 80 entries for 56 neighbours), so entries are
/// first sifted, without a branch; then the kernel is evaluated for the whole block, which the compiler turns
/// into vector instructions.
#[inline(always)]
pub fn blocks<S: Space>(state: &State<S>, a: usize) -> impl Iterator<Item = Block<S>> {
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let h_a = state.smoothing_length(a);
    let own = (S::Real::of(1.0) / h_a, kernel.gradient_factor(h_a));
    let mut entries = state.neighbors_of(a);
    std::iter::from_fn(move || if entries.is_empty() { None } else { Some(next_block(state, a, &mut entries, kernel, h_a, own)) })
}

/// Takes entries until a block is full or none is left.
#[inline(always)]
fn next_block<S: Space>(
    state: &State<S>,
    a: usize,
    entries: &mut &[u32],
    kernel: Scaled<S::Real>,
    h_a: S::Real,
    own: (S::Real, S::Real),
) -> Block<S> {
    let mut entry = [0; LANES];
    let mut x = [S::Vec::default(); LANES];
    let mut h = [h_a; LANES];
    let mut square = [S::Real::of(1.0); LANES];
    let (mut count, mut taken) = (0, 0);
    for &candidate in entries.iter() {
        let apart = separation(state, a, candidate);
        let mut h_ab = h_a;
        if state.method.many_bodies {
            h_ab = S::Real::of(0.5) * (h_a + state.smoothing_length((candidate & NEIGHBOR_MASK) as usize));
        }
        (entry[count], x[count], h[count], square[count]) = (candidate, apart, h_ab, S::inner(apart, apart));
        count += usize::from(square[count] < S::Real::of(4.0) * h_ab * h_ab);
        taken += 1;
        if count == LANES {
            break;
        }
    }
    *entries = &entries[taken..];
    let (mut inverse, mut factor) = ([own.0; LANES], [own.1; LANES]);
    if state.method.many_bodies && h != [h_a; LANES] {
        for lane in 0..LANES {
            (inverse[lane], factor[lane]) = (S::Real::of(1.0) / h[lane], kernel.gradient_factor(h[lane]));
        }
    }
    let mut distance = [S::Real::default(); LANES];
    for (distance, square) in distance.iter_mut().zip(square) {
        *distance = square.sqrt();
    }
    let gradient = kernel.gradients(&distance, &h, &inverse, &factor);
    Block { count, entry, x, distance, h, gradient }
}

impl<S: Space> Block<S> {
    /// W(r, h) of each of the pairs.
    #[inline(always)]
    pub fn weights(&self, kernel: &Scaled<S::Real>) -> [S::Real; LANES] {
        kernel.weights(&self.distance, &self.h)
    }
    #[inline(always)]
    pub fn pairs(&self) -> impl Iterator<Item = Pair<S>> {
        (0..self.count).map(|lane| Pair {
            b: (self.entry[lane] & NEIGHBOR_MASK) as usize,
            image: self.entry[lane] >> NEIGHBOR_BITS,
            x: self.x[lane],
            distance: self.distance[lane],
            h: self.h[lane],
            gradient: self.gradient[lane],
        })
    }
}

/// X_a - X_b
#[inline(always)]
pub fn reference_separation<S: Space>(state: &State<S>, a: usize, entry: u32) -> S::Vec {
    let (b, image) = ((entry & NEIGHBOR_MASK) as usize, entry >> NEIGHBOR_BITS);
    let mut other = state.columns.reference_position[b];
    if image != 0 {
        other = mirror_point::<S>(&state.params, image, other);
    }
    let x = state.columns.reference_position[a] - other;
    if state.method.periodic { nearest_image::<S>(&state.params, x) } else { x }
}

/// v_b - v_a, the neighbour's velocity mirrored if it is an image.
#[inline(always)]
pub fn velocity_difference<S: Space>(state: &State<S>, a: usize, pair: &Pair<S>) -> S::Vec {
    let velocity = &state.columns.velocity;
    let mut v_b = velocity[pair.b];
    if pair.image != 0 {
        v_b = mirror_vector::<S>(&state.params, pair.image, v_b);
    }
    v_b - velocity[a]
}

/// Weight of a pair: 1 unless a scene weakens the kernel sums between two bodies.
#[inline(always)]
pub fn pair_coupling<S: Space>(state: &State<S>, a: usize, b: usize) -> S::Real {
    if state.method.coupling { state.coupling_of(a, b) } else { S::Real::of(1.0) }
}

/// Inverse of a moment matrix, or `otherwise` where the neighbours lie on a line or a plane. The principal moments may be small,
/// as at the corner of a cube, if they are of the same size.
#[inline(always)]
pub fn inverse_or<S: Space>(moment: S::Mat, otherwise: S::Mat) -> S::Mat {
    let determinant = S::determinant(moment);
    let mean = S::trace(moment) * S::Real::of(1.0 / S::DIMENSION as f64);
    let least = (0..S::DIMENSION).fold(S::Real::of(1e-3), |power, _| power * mean);
    if determinant > least { S::adjugate(moment) * (S::Real::of(1.0) / determinant) } else { otherwise }
}

/// Inverse of a moment matrix, or the unit tensor where too few neighbours are left to define one.
#[inline(always)]
pub fn safe_inverse<S: Space>(moment: S::Mat) -> S::Mat {
    let determinant = S::determinant(moment);
    // A particle of a body that tears may keep few neighbours: below this the correction amplifies noise. In space
    // the edges of a body are below it too, where h is large.
    if determinant > S::Real::of(0.02) { S::adjugate(moment) * (S::Real::of(1.0) / determinant) } else { S::mat_identity() }
}
