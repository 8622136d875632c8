//! Everything that the passes of a run read and write, in one precision: the CPU path steps a
//! `State<_<f64>>`; the GPU holds the same tables in buffers of the same layout.

use crate::bond::BondTable;
use crate::fields::{Columns, Field};
use crate::method::Method;
use crate::rows::{Balance, Body, BodyOptions, Clock, Constraint, ContactPair, FacetPair, Mover, Obstacle, Params};
use crate::tensor::{Real, Space};

/// All tables of a run.
#[derive(Clone)]
pub struct State<S: Space> {
    pub method: Method,
    pub params: Params<S::Real>,
    pub clock: Clock<S::Real>,
    /// The clocks of the groups that this state acts between; empty in a group's own state.
    pub group_clocks: Vec<Clock<S::Real>>,
    pub bodies: Vec<Body<S::Real>>,
    /// Numbers of the formulation of each body; empty where the bodies do not differ, since `params` then has them.
    pub body_options: Vec<BodyOptions<S::Real>>,
    /// Weight of the kernel sums between bodies a and b at `a * body_count + b`.
    pub coupling: Vec<S::Real>,
    /// Contact between bodies a and b at `a * body_count + b`.
    pub contact_pairs: Vec<ContactPair<S::Real>>,
    /// Contact of the surfaces of bodies a and b at `a * body_count + b`.
    pub facet_pairs: Vec<FacetPair<S::Real>>,
    pub obstacles: Vec<Obstacle<S::Real>>,
    pub movers: Vec<Mover<S::Real>>,
    /// Contact of obstacle k and body b at `k * body_count + b`.
    pub obstacle_pairs: Vec<FacetPair<S::Real>>,
    pub constraints: Vec<Constraint<S::Real>>,
    /// Points of all time courses: time, and factor of the prescribed velocity or force.
    pub course: Vec<[S::Real; 2]>,
    /// All that has rows by count.
    pub columns: Columns<S>,
    /// The distinct bonds of the reference configuration, kept by the CPU path in the Total Lagrangian formulation.
    pub bond_table: BondTable<S>,
    /// How the descent to equilibrium goes on.
    pub balance: Balance<S::Real>,
}

impl<S: Space> State<S> {
    /// Bytes of all columns, and of what the CPU keeps beside them.
    pub fn bytes(&self) -> u64 {
        let columns: usize = Field::ALL.iter().map(|&field| self.columns.bytes(field).len()).sum();
        (columns + self.bond_table.bytes()) as u64
    }
    /// Entries of a particle's neighbour list.
    #[inline(always)]
    pub fn neighbors_of(&self, a: usize) -> &[u32] {
        let first = a * self.params.list_capacity as usize;
        &self.columns.neighbors[first..first + self.columns.neighbor_count[a] as usize]
    }
    /// Index of a particle's body.
    #[inline(always)]
    pub fn body_index(&self, a: usize) -> usize {
        if self.method.many_bodies { self.columns.body[a] as usize } else { 0 }
    }
    #[inline(always)]
    pub fn body(&self, a: usize) -> &Body<S::Real> {
        &self.bodies[self.body_index(a)]
    }
    /// h of a particle: a number of its body.
    #[inline(always)]
    pub fn smoothing_length(&self, a: usize) -> S::Real {
        self.body(a).smoothing_length
    }
    /// Linear term of the viscosity at a particle: a number of its body where bodies differ, else of the run.
    #[inline(always)]
    pub fn alpha(&self, a: usize) -> S::Real {
        self.options(a).map_or(self.params.alpha, |options| options.alpha)
    }
    /// Quadratic term of the viscosity, likewise.
    #[inline(always)]
    pub fn beta(&self, a: usize) -> S::Real {
        self.options(a).map_or(self.params.beta, |options| options.beta)
    }
    /// Strength of the artificial stress, likewise.
    #[inline(always)]
    pub fn artificial_epsilon(&self, a: usize) -> S::Real {
        self.options(a).map_or(self.params.artificial_epsilon, |options| options.artificial_epsilon)
    }
    /// Strength of the hourglass energy over Young's modulus, likewise.
    #[inline(always)]
    pub fn hourglass(&self, a: usize) -> S::Real {
        self.options(a).map_or(self.params.hourglass, |options| options.hourglass)
    }
    #[inline(always)]
    fn options(&self, a: usize) -> Option<&BodyOptions<S::Real>> {
        if self.method.body_options { Some(&self.body_options[self.body_index(a)]) } else { None }
    }
    /// Reference volume times reference density: constant.
    #[inline(always)]
    pub fn mass(&self, a: usize) -> S::Real {
        self.columns.reference_volume[a] * self.body(a).density
    }
    #[inline(always)]
    pub fn volume(&self, a: usize) -> S::Real {
        self.columns.reference_volume[a] * (S::Real::of(1.0) + self.columns.volumetric_strain[a])
    }
    #[inline(always)]
    pub fn density(&self, a: usize) -> S::Real {
        self.body(a).density / (S::Real::of(1.0) + self.columns.volumetric_strain[a])
    }
    #[inline(always)]
    pub fn position(&self, a: usize) -> S::Vec {
        self.columns.reference_position[a] + self.columns.displacement[a]
    }
    /// Weight of the kernel sums between two particles' bodies.
    #[inline(always)]
    pub fn coupling_of(&self, a: usize, b: usize) -> S::Real {
        self.coupling[self.body_index(a) * self.params.body_count as usize + self.body_index(b)]
    }
    #[inline(always)]
    pub fn contact_pair(&self, a: usize, b: usize) -> &ContactPair<S::Real> {
        &self.contact_pairs[self.body_index(a) * self.params.body_count as usize + self.body_index(b)]
    }
    /// Facets that a particle carries.
    #[inline(always)]
    pub fn facets_of(&self, a: usize) -> std::ops::Range<usize> {
        let first = self.columns.first_facet[a] as usize;
        first..first + self.columns.facets[a] as usize
    }
    #[inline(always)]
    pub fn facet_pair(&self, a: usize, b: usize) -> &FacetPair<S::Real> {
        &self.facet_pairs[self.body_index(a) * self.params.body_count as usize + self.body_index(b)]
    }
    /// Whether a surface or an obstacle acts on facet e. Most are out of touch, and nothing else of them needs to be read.
    #[inline(always)]
    pub fn facet_touched(&self, e: usize) -> bool {
        let is = |column: &[u32]| column.get(e).is_some_and(|&word| word > 0);
        is(&self.columns.facet_pressed) || is(&self.columns.facet_obstacle)
    }
    /// How the surface of particle a touches facet f, where f is in the list of a facet of a. If all touching surfaces have
    /// the same numbers (`facet_alike`), these are read at once, without the bodies of a and f.
    #[inline(always)]
    pub fn listed_pair(&self, a: usize, f: usize) -> &FacetPair<S::Real> {
        if self.params.facet_alike > 0 {
            return &self.facet_pairs[self.params.facet_alike as usize - 1];
        }
        self.facet_pair(a, self.columns.facet_owner[f] as usize)
    }
    /// Particles of a particle's list of contacts.
    #[inline(always)]
    pub fn contacts_of(&self, a: usize) -> impl Iterator<Item = usize> {
        let count = self.params.count as usize;
        (0..self.columns.contact_count[a] as usize).map(move |k| self.columns.contacts[k * count + a] as usize)
    }
    /// Factor of a boundary condition's course at an absolute time.
    pub fn course_factor(&self, constraint: &Constraint<S::Real>, time: S::Real) -> S::Real {
        let first = constraint.course_first as usize;
        let points = &self.course[first..first + constraint.course_count as usize];
        let Some(&[first_time, first_factor]) = points.first() else { return S::Real::of(1.0) };
        if time <= first_time {
            return first_factor;
        }
        for pair in points.windows(2) {
            let ([t0, f0], [t1, f1]) = (pair[0], pair[1]);
            if time < t1 {
                return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
            }
        }
        points[points.len() - 1][1]
    }

    /// Integral of a boundary condition's course between two absolute times.
    pub fn course_integral(&self, constraint: &Constraint<S::Real>, from: S::Real, to: S::Real) -> S::Real {
        let first = constraint.course_first as usize;
        let points = &self.course[first..first + constraint.course_count as usize];
        let Some(&[first_time, first_factor]) = points.first() else { return to - from };
        let [last_time, last_factor] = points[points.len() - 1];
        let zero = S::Real::of(0.0);
        let mut sum = first_factor * (to.min(first_time) - from).max(zero) + last_factor * (to - from.max(last_time)).max(zero);
        for pair in points.windows(2) {
            let ([t0, f0], [t1, f1]) = (pair[0], pair[1]);
            let (low, high) = (from.max(t0), to.min(t1));
            if high > low {
                let middle = S::Real::of(0.5) * (low + high);
                sum += (high - low) * (f0 + (f1 - f0) * (middle - t0) / (t1 - t0));
            }
        }
        sum
    }
}
