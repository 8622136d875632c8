//! Everything that the passes of a run read and write, in one precision: the CPU path steps a
//! `State<_<f64>>`; the GPU holds the same tables in buffers of the same layout.

use crate::bond::BondTable;
use crate::contact;
use crate::contact::zones::{Form, Normals};
use crate::facet::{FacetPair, GapForm};
use crate::material::Law;
use crate::obstacle::Obstacle;
use crate::particles::{Counts, Particles};
use crate::scene::corrected_kernel::{CorrectedKernel, VelocityGradient};
use crate::scene::file::{ArtificialForm, Density, Descent, Gradient, Integrator, Kind};
use crate::smoothing::Smoothing;
use crate::tensor::{Real, Space};

/// Which physics and numerics a run is made of; decides its fields, its passes and its shaders' text.
#[derive(Debug, Clone, PartialEq)]
pub struct Method {
    pub dimension: usize,
    pub kind: Kind,
    /// Options of that kind.
    pub corrected_kernel: Option<CorrectedKernel>,
    /// Laws of the scene's materials, each once, in order of their numbers.
    pub laws: Vec<Law>,
    pub smoothing: Smoothing,
    pub integrator: Integrator,
    /// Equilibrium instead of motion, and how it is found.
    pub quasi_static: Option<Descent>,
    pub density: Density,
    pub gradient: Gradient,
    /// Some material resists shear.
    pub shear: bool,
    pub many_bodies: bool,
    /// Some pair of bodies does not act as one through the kernel.
    pub coupling: bool,
    pub constraints: bool,
    pub symmetry: bool,
    pub periodic: bool,
    pub body_force: bool,
    /// Energy against motions that the deformation gradient does not see.
    pub hourglass: bool,
    /// On the CPU, keep the distinct bonds.
    pub bond_table: bool,
    /// How surfaces touch.
    pub contact: contact::Laws,
    /// Surfaces keep apart by their facets.
    pub gap: Option<GapForm>,
    /// Rigid obstacles stand in the way.
    pub obstacles: bool,
    /// Facets rub.
    pub friction: bool,
    pub viscosity: bool,
    pub xsph: bool,
    pub velocity_filter: bool,
    pub artificial_stress: Option<ArtificialForm>,
    pub internal_energy: bool,
    pub dissipated_energy: bool,
    /// Sums of displacement and velocity keep the digits that f32 would drop.
    pub compensated: bool,
}

impl Method {
    /// Stress follows from the deformation gradient.
    pub fn finite_strain(&self) -> bool {
        self.kind != Kind::Eulerian
    }
    /// The neighbour list follows the particles.
    pub fn list_follows(&self) -> bool {
        self.kind == Kind::Eulerian || self.corrected_kernel.is_some_and(|options| options.current())
    }
    /// Some list must follow the particles.
    pub fn listed_again(&self) -> bool {
        self.list_follows() || self.contact.any() || self.gap.is_some()
    }
    /// Bodies touch by pieces of their surfaces.
    pub fn facets(&self) -> bool {
        self.gap.is_some() || self.obstacles
    }
    /// Steps are made of stages.
    pub fn staged(&self) -> bool {
        !matches!(self.integrator, Integrator::Leapfrog | Integrator::Pefrl)
    }
    /// Viscosity turns energy into heat at a rate that the kicks add up; a law that relaxes adds up its own.
    pub fn dissipated_power(&self) -> bool {
        self.dissipated_energy && self.viscosity
    }
    /// Stress follows from the deformation gradient and from what some law remembers beside it.
    pub fn memory(&self) -> bool {
        self.finite_strain() && self.laws.iter().any(|law| law.has_memory())
    }
    /// Some law yields.
    pub fn plastic(&self) -> bool {
        self.laws.contains(&Law::J2)
    }
    /// The words that `#if` knows in the shaders.
    pub fn flags(&self) -> Vec<&'static str> {
        let (eulerian, sums) = (self.kind == Kind::Eulerian, self.corrected_kernel);
        let option = |has: fn(CorrectedKernel) -> bool| sums.is_some_and(has);
        let all = [
            ("line", self.dimension == 1),
            ("plane", self.dimension == 2),
            ("solid", self.dimension == 3),
            ("fire", self.quasi_static == Some(Descent::Fire)),
            ("finite_strain", self.finite_strain()),
            ("list_follows", self.list_follows()),
            ("staged", self.staged()),
            ("correction", option(|sums| sums.correction)),
            ("current", option(CorrectedKernel::current)),
            ("evolved", option(CorrectedKernel::evolved)),
            ("kept_gradients", option(CorrectedKernel::keeps_gradients)),
            ("difference", option(|sums| sums.velocity_gradient == VelocityGradient::Difference)),
            ("hourglass", self.hourglass),
            ("contact", self.contact.with_energy()),
            ("potentials", !self.contact.potentials.is_empty()),
            ("colour_field", self.contact.colour_field),
            ("zones_printed", self.contact.zones.is_some_and(|zones| zones.form == Form::Printed)),
            ("zones_all", self.contact.zones.is_some_and(|zones| zones.normals == Normals::All)),
            ("zones_friction", self.contact.zones.is_some_and(|zones| zones.friction)),
            ("facets", self.facets()),
            ("gap", self.gap.is_some()),
            ("along_normals", self.gap == Some(GapForm::AlongNormals)),
            ("obstacles", self.obstacles),
            ("friction", self.friction),
            ("listed_again", self.listed_again()),
            ("memory", self.memory()),
            ("plastic", self.plastic()),
            ("quasi_static", self.quasi_static.is_some()),
            ("shear", eulerian && self.shear),
            ("many_bodies", self.many_bodies),
            ("coupling", self.coupling),
            ("constraints", self.constraints),
            ("symmetry", self.symmetry),
            ("periodic", self.periodic),
            ("body_force", self.body_force),
            ("viscosity", self.viscosity),
            ("xsph", self.xsph),
            ("artificial_stress", self.artificial_stress.is_some()),
            ("scalar_form", self.artificial_stress == Some(ArtificialForm::Scalar)),
            ("principal_form", self.artificial_stress == Some(ArtificialForm::Principal)),
            ("continuity", eulerian && self.density == Density::Continuity),
            ("correct_rate", self.gradient != Gradient::Plain),
            ("quadratic_gradient", self.gradient == Gradient::Quadratic),
            ("adjoint", self.gradient == Gradient::Adjoint),
            ("internal_energy", self.internal_energy),
            ("dissipated_energy", self.dissipated_energy),
            ("dissipated_power", self.dissipated_power()),
            ("pair_velocity", self.viscosity || self.internal_energy),
            ("pair_volume", self.viscosity || self.gradient == Gradient::Adjoint),
            ("compensated", self.compensated),
        ];
        all.iter().filter(|(_, on)| *on).map(|(word, _)| *word).collect()
    }
}

/// Numbers that stay the same during a run. Twin: `shaders/lib/params.wgsl`; a test compares the offsets.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Params<R> {
    /// Axis-aligned mirror planes: normal and distance from the origin along it.
    pub planes: [[R; 4]; 3],
    pub count: u32,
    /// First particle, and number of particles, of the part of the neighbour list that is bound.
    pub first: u32,
    pub chunk: u32,
    pub list_capacity: u32,
    pub cells_x: u32,
    pub cells_y: u32,
    pub cells_z: u32,
    pub cell_total: u32,
    pub plane_count: u32,
    pub body_count: u32,
    pub artificial_exponent: u32,
    pub contact_capacity: u32,
    pub facet_count: u32,
    /// Entries that a facet's list of contacts can hold.
    pub facet_capacity: u32,
    pub obstacle_count: u32,
    /// Place of the one pair that stands for all where all surfaces touch alike, plus 1; else 0.
    pub facet_alike: u32,
    /// Most neighbours that a particle on a surface has, and one at a corner.
    pub surface_count: u32,
    pub corner_count: u32,
    /// Always zero; the compiler does not know it.
    pub zero: u32,
    pub origin_x: R,
    pub origin_y: R,
    pub origin_z: R,
    pub cell_x: R,
    pub cell_y: R,
    pub cell_z: R,
    /// Period of the box along each axis, 0 where it is open.
    pub period_x: R,
    pub period_y: R,
    pub period_z: R,
    pub body_force_x: R,
    pub body_force_y: R,
    pub body_force_z: R,
    /// Constant of the smoothing kernel in this dimension.
    pub normalisation: R,
    /// Distance up to which pairs enter the neighbour list.
    pub reach: R,
    /// Distance up to which pairs enter the list of contacts.
    pub contact_reach: R,
    /// Distance up to which pairs enter the list of facets.
    pub facet_reach: R,
    /// Rate that the stiffness of contact by facets adds to that of waves over h, in squares.
    pub contact_rate: R,
    /// Particles of one body touch only if they were farther apart than this.
    pub contact_apart: R,
    /// Displacement after which the list must be built anew.
    pub slack: R,
    /// Strength of the hourglass energy, over Young's modulus.
    pub hourglass: R,
    pub alpha: R,
    pub beta: R,
    pub softening: R,
    /// Weight of the neighbours in the smoothed velocity.
    pub smoothing_weight: R,
    pub artificial_epsilon: R,
    /// Kernel at the spacing where the artificial stress has its nominal strength.
    pub artificial_weight: R,
    pub cfl: R,
    /// Fixed time step, or 0.
    pub fixed_step: R,
    /// Out-of-balance force over the force scale at which a load step ends.
    pub residual: R,
    /// Part of the load that is added in a unit of pseudo-time.
    pub load_rate: R,
}

/// Numbers of one body and its material. Twin: `Body` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Body<R> {
    /// Number of the material's law.
    pub law: u32,
    pub padding: u32,
    /// Density when unstressed.
    pub density: R,
    pub bulk_modulus: R,
    pub shear_modulus: R,
    pub youngs_modulus: R,
    /// Rate at which a Maxwell body relaxes, shear modulus over viscosity; 0 for all others.
    pub relaxation: R,
    /// Yield stress of a J2 body before it hardens; 0 for all others.
    pub yield_stress: R,
    /// What hardening adds to it: coefficient times the equivalent plastic strain to the power of the exponent.
    pub hardening: R,
    pub hardening_exponent: R,
    /// Speed of longitudinal waves.
    pub sound_speed: R,
    pub smoothing_length: R,
}

/// How two bodies touch. Twin: `ContactPair` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct ContactPair<R> {
    /// Number of the law: of [`contact::Potential::ALL`], [`contact::COLOUR_FIELD`] or [`contact::ZONES`].
    pub law: u32,
    /// n of Strand's repulsive force.
    pub exponent: u32,
    /// Factor of the potential, an energy; k of the colour field; the zones' force.
    pub strength: R,
    /// Distance at which it ends, half side of the zones; 0 where the bodies do not touch.
    pub range: R,
    /// c0 of the colour field.
    pub threshold: R,
    /// Coefficient of friction in the zones.
    pub friction: R,
}

/// What moves a rigid obstacle. Twin: `Mover` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Mover<R> {
    /// Boundary condition that gives its velocity, plus 1; 0 for none.
    pub condition: u32,
    /// 0 where the motion is prescribed.
    pub inverse_mass: R,
}

impl<R> Params<R> {
    /// Blocks of the reduction over facets.
    pub fn facet_blocks(&self) -> usize {
        (self.facet_count as usize).div_ceil(REDUCTION_BLOCK)
    }
    pub fn counts(&self) -> Counts {
        Counts { particles: self.count as usize, facets: self.facet_count as usize, obstacles: self.obstacle_count as usize }
    }
}

impl ContactPair<f64> {
    /// Distance within which particles may touch: for zones, that of a corner of the square.
    pub fn reach(&self) -> f64 {
        if self.law == contact::ZONES { std::f64::consts::SQRT_2 * self.range } else { self.range }
    }
    pub fn map<R: Real>(&self, real: impl Fn(f64) -> R) -> ContactPair<R> {
        ContactPair {
            law: self.law,
            exponent: self.exponent,
            strength: real(self.strength),
            range: real(self.range),
            threshold: real(self.threshold),
            friction: real(self.friction),
        }
    }
}

/// A boundary condition. Twin: `Constraint` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Constraint<R> {
    /// Bit k: the velocity along axis k is prescribed.
    pub prescribed: u32,
    /// Points of the time course: first, number.
    pub course_first: u32,
    pub course_count: u32,
    pub padding: u32,
    /// Prescribed velocity where prescribed, else an acceleration added.
    pub x: R,
    pub y: R,
    pub z: R,
    pub unused: R,
}

/// The run's clock, kept where the steps run. Twin: `Clock` in `shaders/lib/params.wgsl`.
///
/// Time counts from the start of the present segment, so that f32 keeps its digits in long runs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C)]
pub struct Clock<R> {
    /// Absolute time at which the segment began.
    pub start: R,
    pub elapsed: R,
    pub elapsed_carry: R,
    /// The next step.
    pub step: R,
    /// Length of the segment.
    pub duration: R,
    pub steps_left: u32,
    pub steps_done: u32,
    /// 0 once the segment is over: every pass then leaves the state alone.
    pub running: u32,
    /// 1 if the next step must build the neighbour list.
    pub rebuild: u32,
    /// Times that the list was built.
    pub lists_built: u32,
    /// What went wrong, as [`Fault`] numbers it; 0 while all is well.
    pub fault: u32,
    /// Out-of-balance force over the force scale, where equilibrium is sought.
    pub residual: R,
}

impl<R: Real> Clock<R> {
    pub fn to_f64(self) -> Clock<f64> {
        Clock {
            start: self.start.f64(),
            elapsed: self.elapsed.f64(),
            elapsed_carry: self.elapsed_carry.f64(),
            step: self.step.f64(),
            duration: self.duration.f64(),
            steps_left: self.steps_left,
            steps_done: self.steps_done,
            running: self.running,
            rebuild: self.rebuild,
            lists_built: self.lists_built,
            fault: self.fault,
            residual: self.residual.f64(),
        }
    }
}

/// How the descent to equilibrium goes on. Twin: `Balance` in `shaders/lib/params.wgsl`.
///
/// A step does u += back v, then v = keep v + push a, then u += forward v.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C)]
pub struct Balance<R> {
    pub back: R,
    pub keep: R,
    pub push: R,
    pub forward: R,
    /// Part of the velocity that FIRE turns to the direction of the force.
    pub mixing: R,
    /// Longest step that is stable.
    pub longest: R,
    /// Steps since the power of the forces was last negative.
    pub downhill: u32,
    pub padding: u32,
}

/// Reasons for a device to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    ListFull = 1,
    NotFinite = 2,
    Inverted = 3,
    NoEquilibrium = 4,
}

impl Fault {
    pub fn from_number(number: u32) -> Option<Self> {
        [Fault::ListFull, Fault::NotFinite, Fault::Inverted, Fault::NoEquilibrium]
            .into_iter()
            .find(|fault| *fault as u32 == number)
    }
    pub fn sentence(self) -> &'static str {
        match self {
            Fault::ListFull => {
                "a particle has more neighbours than its list can hold; particles may have clumped, or raise formulation.list_capacity"
            }
            Fault::NotFinite => "a velocity or stress is no longer a number; the time step may be too long",
            Fault::Inverted => "a particle's volume fell to zero or below; the time step may be too long or the load too great",
            Fault::NoEquilibrium => "no equilibrium was found within quasi_static.most_steps",
        }
    }
}

/// Low bits of a neighbour-list entry: the neighbour; the three bits above: the planes it is mirrored in.
pub const NEIGHBOR_BITS: u32 = 29;
pub const NEIGHBOR_MASK: u32 = (1 << NEIGHBOR_BITS) - 1;
/// Cells that one block of the prefix sum covers; values that one block of a reduction covers.
pub const SCAN_BLOCK: usize = 1024;
pub const REDUCTION_BLOCK: usize = 256;

/// All tables of a run.
#[derive(Clone)]
pub struct State<S: Space> {
    pub method: Method,
    pub params: Params<S::Real>,
    pub clock: Clock<S::Real>,
    pub bodies: Vec<Body<S::Real>>,
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
    /// Time and factor.
    pub course: Vec<[S::Real; 2]>,
    pub particles: Particles<S>,
    /// Particles in each cell while they are being binned; zero otherwise.
    pub cell_count: Vec<u32>,
    /// Where each cell's particles begin in `cell_particles`; one more than there are cells.
    pub cell_start: Vec<u32>,
    /// Cells' particles before each block of the prefix sum.
    pub cell_block: Vec<u32>,
    pub cell_particles: Vec<u32>,
    /// Row of `list_capacity` entries for each particle.
    pub neighbors: Vec<u32>,
    /// Entry k of particle a's list of contacts at `k * count + a`.
    pub contacts: Vec<u32>,
    /// Entry k of facet e's list of contacts at `k * facet_count + e`.
    pub facet_contacts: Vec<u32>,
    /// Force on obstacle k from block j of the facets at `k * blocks + j`.
    pub block_load: Vec<S::Vec>,
    /// Force of particle a's zone on that entry; empty unless some bodies touch by zones.
    pub zone_forces: Vec<S::Vec>,
    /// Neighbours of the reference configuration, kept beside a list that follows the particles: entry k of
    /// particle a at `k * count + a`, and with it V_b times the gradient at a of b's shape function.
    pub kept_neighbors: Vec<u32>,
    pub kept_gradients: Vec<S::Vec>,
    /// Total Lagrangian on the CPU.
    pub bond_table: BondTable<S>,
    /// Largest rate, squared displacement since the list was built, squared speed, and fault, of each block.
    pub block_bound: Vec<[S::Real; 4]>,
    /// How the descent to equilibrium goes on.
    pub balance: Balance<S::Real>,
    /// What `bound_residual` finds in each block; empty unless equilibrium is sought.
    pub block_residual: Vec<[S::Real; 8]>,
}

impl<S: Space> State<S> {
    /// Entries of a particle's neighbour list.
    #[inline(always)]
    pub fn neighbors_of(&self, a: usize) -> &[u32] {
        let first = a * self.params.list_capacity as usize;
        &self.neighbors[first..first + self.particles.neighbor_count[a] as usize]
    }
    /// Index of a particle's body.
    #[inline(always)]
    pub fn body_index(&self, a: usize) -> usize {
        if self.method.many_bodies { self.particles.body[a] as usize } else { 0 }
    }
    #[inline(always)]
    pub fn body(&self, a: usize) -> &Body<S::Real> {
        &self.bodies[self.body_index(a)]
    }
    /// Reference volume times reference density: constant.
    #[inline(always)]
    pub fn mass(&self, a: usize) -> S::Real {
        self.particles.reference_volume[a] * self.body(a).density
    }
    #[inline(always)]
    pub fn volume(&self, a: usize) -> S::Real {
        self.particles.reference_volume[a] * (S::Real::of(1.0) + self.particles.volumetric_strain[a])
    }
    #[inline(always)]
    pub fn density(&self, a: usize) -> S::Real {
        self.body(a).density / (S::Real::of(1.0) + self.particles.volumetric_strain[a])
    }
    #[inline(always)]
    pub fn position(&self, a: usize) -> S::Vec {
        self.particles.reference_position[a] + self.particles.displacement[a]
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
        let first = self.particles.first_facet[a] as usize;
        first..first + self.particles.facets[a] as usize
    }
    #[inline(always)]
    pub fn facet_pair(&self, a: usize, b: usize) -> &FacetPair<S::Real> {
        &self.facet_pairs[self.body_index(a) * self.params.body_count as usize + self.body_index(b)]
    }
    /// Whether a surface or an obstacle acts on facet e. Most are out of touch, and nothing else of them needs to be read.
    #[inline(always)]
    pub fn facet_touched(&self, e: usize) -> bool {
        let is = |column: &[u32]| column.get(e).is_some_and(|&word| word > 0);
        is(&self.particles.facet_pressed) || is(&self.particles.facet_obstacle)
    }
    /// How the surface of particle a touches facet f, which is in the list of one of a's: nowhere else to be looked up
    /// if all surfaces touch alike.
    #[inline(always)]
    pub fn listed_pair(&self, a: usize, f: usize) -> &FacetPair<S::Real> {
        if self.params.facet_alike > 0 {
            return &self.facet_pairs[self.params.facet_alike as usize - 1];
        }
        self.facet_pair(a, self.particles.facet_owner[f] as usize)
    }
    /// Particles of a particle's list of contacts.
    #[inline(always)]
    pub fn contacts_of(&self, a: usize) -> impl Iterator<Item = usize> {
        let count = self.params.count as usize;
        (0..self.particles.contact_count[a] as usize).map(move |k| self.contacts[k * count + a] as usize)
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
