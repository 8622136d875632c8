//! Neighbours in the reference configuration, as the passes of the Total Lagrangian formulation see them.
//! Twin: shaders/lib/bond.wgsl
//!
//! A pass takes its bonds from one of two sources: [`Listed`] evaluates the kernel anew at each bond, as the
//! shaders do, which costs little memory; [`Tabulated`] looks the kernel up in a table of the scene's distinct bonds, which
//! runs three times as fast on the CPU. A lattice has only as many distinct bonds as a particle has neighbours.
//!
//! Measured with 100,000 particles on a cubic lattice in f64, in particle-updates per core-second: the kernel
//! evaluated bond by bond 1.0e6, in blocks of eight 1.5e6, stored with each bond 1.8e6 (the memory is the limit),
//! stored with each distinct bond 3.7e6.
//!
//! # Tied bodies
//! A bond between bodies that are tied counts at its end a by the weight 2 E_b/(E_a + E_b), which is 1 within a body. The
//! weight stands in all sums of a alike: the fit that gives F_a is exact for linear displacements whatever the weights are,
//! and the energy, see [`crate::pass::bond_force`], has a's weight in a's part of it, so that forces remain its
//! derivative. The weight is the part of a bond's stretch that falls to a's half where the two halves are pulled in series.
//! With 1 for all bonds the softer body would hardly deform within a kernel's support of the stiffer one, since the energy
//! of the stiffer one's particles would ask for it: a round inclusion 70 times as stiff as its matrix, of radius 12
//! spacings, acted as one that is larger by more than a spacing (displacements around it 14 % wrong, stress at its
//! edge 3.9 times the exact one); with the weight these are 4 % and 1.8.

use crate::pair::{mirror_vector, pair_coupling, reference_separation};
use crate::rows::{NEIGHBOR_BITS, NEIGHBOR_MASK};
use crate::smoothing::{LANES, Scaled};
use crate::state::State;
use crate::tensor::{Linear, Real, Space};
use std::collections::HashMap;
use std::ops::Range;

/// A neighbour in the reference configuration.
#[derive(Clone, Copy)]
pub struct Bond<S: Space> {
    pub b: usize,
    /// Planes that the neighbour is mirrored in, one bit each.
    pub image: u32,
    pub row: Row<S>,
}

/// What a bond's place in the reference configuration fixes, and the two bodies that it joins.
#[derive(Clone, Copy)]
pub struct Row<S: Space> {
    /// X_a - X_b
    pub x: S::Vec,
    /// V_b grad_a W_ab, times a's weight where the two are tied
    pub gradient: S::Vec,
    /// V_b (dW/dR)/R, likewise
    pub weight: S::Real,
}

impl<S: Space> Row<S> {
    fn new(x: S::Vec, slope: S::Real, volume: S::Real) -> Self {
        let weight = slope * volume;
        Self { x, gradient: x * weight, weight }
    }
}

/// Where a pass has its bonds from: `for part in B::parts(state, a) { let block = B::load(state, a, part); … }`, then
/// `B::bond(&block, lane)` for each of the part. Plain loops over a local block: as iterators the blocks were moved
/// about in memory, which took most of the time.
pub trait Source<S: Space> {
    /// Some bonds may end in a mirror image. Without the branch for these a loop stays in vector registers.
    const IMAGES: bool;
    /// Some bonds may end in another body, likewise.
    const TIES: bool;
    /// The bonds of a part, made ready together.
    type Block<'s>;
    /// The particle's list in parts.
    fn parts(state: &State<S>, a: usize) -> impl Iterator<Item = Range<usize>>;
    fn load(state: &State<S>, a: usize, part: Range<usize>) -> Self::Block<'_>;
    fn bond(block: &Self::Block<'_>, lane: usize) -> Bond<S>;
}

/// Bonds evaluated anew, eight together. The kernel is chosen for each eight, not for the whole loop: the passes are
/// then compiled once instead of once for each kernel.
pub struct Listed;

/// Bonds looked up in the state's table; ALIKE if none ends in a mirror image or in another body.
pub struct Tabulated<const ALIKE: bool>;

/// Runs `$body` with `$B` naming the source of the state's bonds.
macro_rules! with_bonds {
    ($state:expr, $B:ident => $body:expr) => {
        if $state.bond_table.rows.is_empty() {
            type $B = $crate::bond::Listed;
            $body
        } else {
            if $state.method.symmetry || $state.method.tied {
                type $B = $crate::bond::Tabulated<false>;
                $body
            } else {
                type $B = $crate::bond::Tabulated<true>;
                $body
            }
        }
    };
}
pub(crate) use with_bonds;

impl<S: Space> Source<S> for Listed {
    const IMAGES: bool = true;
    const TIES: bool = true;
    type Block<'s> = Lanes<S>;

    #[inline(always)]
    fn parts(state: &State<S>, a: usize) -> impl Iterator<Item = Range<usize>> {
        let count = state.neighbors_of(a).len();
        (0..count).step_by(LANES).map(move |first| first..(first + LANES).min(count))
    }
    #[inline(always)]
    fn load(state: &State<S>, a: usize, part: Range<usize>) -> Lanes<S> {
        Lanes::new(state, a, &state.neighbors_of(a)[part])
    }
    #[inline(always)]
    fn bond(block: &Lanes<S>, lane: usize) -> Bond<S> {
        let (b, image) = split(block.entry[lane]);
        Bond { b, image, row: block.row(lane) }
    }
}

/// The rows of eight bonds, component by component, so that the processor works on all eight together.
pub struct Lanes<S: Space> {
    entry: [u32; LANES],
    x: [[S::Real; LANES]; 3],
    gradient: [[S::Real; LANES]; 3],
    weight: [S::Real; LANES],
}

impl<S: Space> Lanes<S> {
    #[inline(always)]
    fn new(state: &State<S>, a: usize, entries: &[u32]) -> Self {
        let h = state.smoothing_length(a);
        // A lane that is left over has no weight.
        let (mut x, mut weight) = ([[h; LANES]; 3], [S::Real::default(); LANES]);
        let mut own = [0; LANES];
        for (lane, &entry) in entries.iter().enumerate() {
            let apart = reference_separation(state, a, entry);
            for k in 0..S::DIMENSION {
                x[k][lane] = apart[k];
            }
            own[lane] = entry;
            let b = split(entry).0;
            weight[lane] = state.columns.reference_volume[b] * end_weight(state, a, b);
        }
        let mut square = [S::Real::default(); LANES];
        for component in x.iter().take(S::DIMENSION) {
            for (sum, &x) in square.iter_mut().zip(component) {
                *sum += x * x;
            }
        }
        let slope = slopes(state, square, h);
        let mut gradient = x;
        for lane in 0..LANES {
            weight[lane] = weight[lane] * slope[lane];
        }
        for component in gradient.iter_mut().take(S::DIMENSION) {
            for (x, &weight) in component.iter_mut().zip(&weight) {
                *x = *x * weight;
            }
        }
        Self { entry: own, x, gradient, weight }
    }

    #[inline(always)]
    fn row(&self, lane: usize) -> Row<S> {
        let gather = |from: &[[S::Real; LANES]; 3]| {
            let mut v = S::Vec::default();
            for k in 0..S::DIMENSION {
                v[k] = from[k][lane];
            }
            v
        };
        Row { x: gather(&self.x), gradient: gather(&self.gradient), weight: self.weight[lane] }
    }
}

/// (dW/dR)/R at the roots of squared distances.
#[inline(always)]
fn slopes<S: Space>(state: &State<S>, square: [S::Real; LANES], h: S::Real) -> [S::Real; LANES] {
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let (inverse, factor) = ([S::Real::of(1.0) / h; LANES], [kernel.gradient_factor(h); LANES]);
    kernel.gradients(&square.map(S::Real::sqrt), &[h; LANES], &inverse, &factor)
}

/// A particle's list with the rows of its bonds.
pub struct Places<'s, S: Space> {
    entries: &'s [u32],
    places: &'s [u32],
    rows: &'s [Row<S>],
}

impl<S: Space, const ALIKE: bool> Source<S> for Tabulated<ALIKE> {
    const IMAGES: bool = !ALIKE;
    const TIES: bool = !ALIKE;
    type Block<'s> = Places<'s, S>;

    #[inline(always)]
    fn parts(state: &State<S>, a: usize) -> impl Iterator<Item = Range<usize>> {
        std::iter::once(0..state.neighbors_of(a).len())
    }
    #[inline(always)]
    fn load(state: &State<S>, a: usize, part: Range<usize>) -> Places<'_, S> {
        let first = a * state.params.list_capacity as usize;
        let places = &state.bond_table.place[first..first + part.len()];
        Places { entries: &state.neighbors_of(a)[part], places, rows: &state.bond_table.rows }
    }
    #[inline(always)]
    fn bond(block: &Places<S>, lane: usize) -> Bond<S> {
        let (b, image) = split(block.entries[lane]);
        Bond { b, image, row: block.rows[block.places[lane] as usize] }
    }
}

#[inline(always)]
fn split(entry: u32) -> (usize, u32) {
    ((entry & NEIGHBOR_MASK) as usize, entry >> NEIGHBOR_BITS)
}

/// u_b - u_a, the neighbour's displacement mirrored if it is an image.
#[inline(always)]
pub fn displacement_difference<S: Space, B: Source<S>>(state: &State<S>, a: usize, bond: &Bond<S>) -> S::Vec {
    let displacement = &state.columns.displacement;
    let mut u_b = displacement[bond.b];
    if B::IMAGES && bond.image != 0 {
        u_b = mirror_vector::<S>(&state.params, bond.image, u_b);
    }
    u_b - displacement[a]
}

/// Weight of a bond in the sums of its end a: see the head of this file.
#[inline(always)]
fn end_weight<S: Space>(state: &State<S>, a: usize, b: usize) -> S::Real {
    if state.method.tied { pair_coupling(state, a, b) } else { S::Real::of(1.0) }
}

/// Weight of a bond at its far end b over that at a, whose rows have the latter.
#[inline(always)]
pub fn far_weight<S: Space, B: Source<S>>(state: &State<S>, a: usize, b: usize) -> S::Real {
    if B::TIES && state.method.tied { pair_coupling(state, b, a) / pair_coupling(state, a, b) } else { S::Real::of(1.0) }
}

/// Strength of the hourglass energy times Young's modulus. Where a body has flowed, this is multiplied by the square of
/// s0/(s0 + 3 mu k), the secant stiffness of a perfectly plastic body over the elastic one. An elastic hourglass term would go
/// on carrying load where the material cannot, and one that follows the secant itself would carry a part of the yield stress.
#[inline(always)]
pub fn hourglass_stiffness<S: Space>(state: &State<S>, a: usize) -> S::Real {
    let body = state.body(a);
    let elastic = state.hourglass(a) * body.youngs_modulus;
    if !state.method.plastic() || body.yield_stress == S::Real::of(0.0) {
        return elastic;
    }
    let columns = &state.columns;
    // In a descent to equilibrium the strain is that of the last equilibrium, so that forces stay the derivative of an energy.
    let settled = state.method.quasi_static.is_some();
    let k = if settled { columns.equilibrium_plastic_strain[a] } else { columns.equivalent_plastic_strain[a] };
    let secant = body.yield_stress / (body.yield_stress + S::Real::of(3.0) * body.shear_modulus * k);
    elastic * secant * secant
}

/// The distinct bonds of a scene, on the CPU only. The table is empty before it is made, and if there are too many bonds.
#[derive(Clone)]
pub struct BondTable<S: Space> {
    pub rows: Vec<Row<S>>,
    /// Row of each entry of the neighbour list.
    pub place: Vec<u32>,
}

/// More distinct bonds than this, in a large scene without a lattice, are evaluated anew.
const MOST_ROWS: usize = 1 << 22;

/// Bonds are the same if their ends are, to this part of the smoothing length: well above the rounding of
/// positions, and below all that matters. A power of two, so that opposite bonds stay opposite to the last bit.
const QUANTUM: f64 = 1.0 / (1u64 << 36) as f64;

impl<S: Space> Default for BondTable<S> {
    fn default() -> Self {
        Self { rows: Vec::new(), place: Vec::new() }
    }
}

impl<S: Space> BondTable<S> {
    pub fn new(state: &State<S>) -> Self {
        let mut table = Self { rows: Vec::new(), place: vec![0; state.columns.neighbors.len()] };
        let mut known = HashMap::new();
        for a in 0..state.params.count as usize {
            let first = a * state.params.list_capacity as usize;
            for (k, &entry) in state.neighbors_of(a).iter().enumerate() {
                let (key, row) = distinct(state, a, entry);
                let place = *known.entry(key).or_insert_with(|| {
                    table.rows.push(row);
                    table.rows.len() - 1
                });
                table.place[first + k] = place as u32;
            }
            if table.rows.len() > MOST_ROWS {
                return Self::default();
            }
        }
        table
    }

    pub fn bytes(&self) -> usize {
        std::mem::size_of_val(&self.rows[..]) + 4 * self.place.len()
    }
}

/// Place of a bond in quanta, with its weight times the neighbour's volume and the body's smoothing length; and its row.
fn distinct<S: Space>(state: &State<S>, a: usize, entry: u32) -> (([i64; 3], u64, u64), Row<S>) {
    let h = state.smoothing_length(a);
    let quantum = QUANTUM * h.f64();
    let mut x = reference_separation(state, a, entry);
    let mut steps = [0; 3];
    for k in 0..S::DIMENSION.min(S::Vec::LENGTH) {
        let whole = (x[k].f64() / quantum).round();
        (steps[k], x[k]) = (whole as i64, S::Real::of(whole * quantum));
    }
    let kernel = Scaled::<S::Real>::new(state.method.smoothing, S::DIMENSION);
    let slope = kernel.gradient(S::inner(x, x).sqrt(), h);
    let b = split(entry).0;
    let volume = state.columns.reference_volume[b] * end_weight(state, a, b);
    ((steps, volume.f64().to_bits(), h.f64().to_bits()), Row::new(x, slope, volume))
}
