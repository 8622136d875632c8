//! Rows of the tables that host and device share: numbers alone, in the layout of their twins in `shaders/lib`.
//!
//! Lengths, times and masses are in the scene's own units.

use crate::contact;
use crate::fields::Counts;
use crate::material::NUMBERS;
use crate::tensor::Real;

/// Numbers that stay the same during a run. Twin: `shaders/lib/params.wgsl`; a test compares the offsets.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Params<R> {
    /// Axis-aligned mirror planes: normal and distance from the origin along it.
    pub planes: [[R; 4]; 3],
    pub count: u32,
    /// First particle, and number of particles, of the part of the neighbour list that a dispatch has bound.
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
    /// If every two touching surfaces have the same numbers: index of one such pair in the table of facet pairs, plus 1, so
    /// that loops read that row and look up no body. 0 if the numbers differ.
    pub facet_alike: u32,
    /// A particle with at most `surface_count` neighbours lies on a surface, with at most `corner_count` at a corner.
    pub surface_count: u32,
    pub corner_count: u32,
    /// Always 0. Shaders combine sums with it by exclusive or: a compiler cannot know that it is 0, and so cannot simplify
    /// (a + b) - a to b, which would lose the rounding error that compensated sums keep.
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
    /// Square of the rate (1/time^2) that the stiffness of contact by facets gives a particle. The bound on the time step is
    /// the root of this number plus the square of the rate of waves, c/h.
    pub contact_rate: R,
    /// Particles of one body touch only if they were farther apart than this.
    pub contact_apart: R,
    /// Displacement of a particle (length) after which the neighbour list must be built anew.
    pub slack: R,
    /// Strength of the hourglass energy, over Young's modulus. Where bodies differ in this and in the numbers of viscosity and
    /// artificial stress, the largest of them all: [`BodyOptions`] has each body's own, and the bound on the time step takes
    /// these.
    pub hourglass: R,
    pub alpha: R,
    pub beta: R,
    pub softening: R,
    /// Weight of the neighbours in the smoothed velocity.
    pub smoothing_weight: R,
    pub artificial_epsilon: R,
    /// W at the spacing where the artificial stress has its nominal strength, f = 1.
    pub artificial_weight: R,
    pub cfl: R,
    /// Fixed time step, or 0.
    pub fixed_step: R,
    /// Longest step of the bodies when unstressed, a time; 0 if it is not known.
    pub rest_step: R,
    /// Time that divides the time between any two outputs; 0 if there is none.
    pub interval: R,
    /// Step times angular frequency up to which the integrator is trusted; 0 if it has no limit, or the method no frequencies.
    pub stable: R,
    /// Out-of-balance force over the force scale at which a load step ends.
    pub residual: R,
    /// Part of the load that is added in a unit of pseudo-time.
    pub load_rate: R,
}

impl<R> Params<R> {
    pub fn counts(&self) -> Counts {
        Counts {
            particles: self.count as usize,
            facets: self.facet_count as usize,
            obstacles: self.obstacle_count as usize,
            cells: self.cell_total as usize,
            list_capacity: self.list_capacity as usize,
            contact_capacity: self.contact_capacity as usize,
            facet_capacity: self.facet_capacity as usize,
        }
    }
}

/// Numbers of one body and its material. Twin: `Body` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Body<R> {
    /// The body's law for each role, as [`crate::material::Law::number`] gives it, 0 for none: either `whole`, or the others.
    pub whole: u32,
    pub pressure: u32,
    pub strength: u32,
    pub heat: u32,
    /// Density when unstressed.
    pub density: R,
    pub bulk_modulus: R,
    pub shear_modulus: R,
    pub youngs_modulus: R,
    /// Mises stress that the strength bears before anything has flowed; 0 for a body that does not yield.
    pub yield_stress: R,
    /// Speed of longitudinal waves.
    pub sound_speed: R,
    pub smoothing_length: R,
    /// Highest angular frequency of the body's particles when unstressed, 1/time; 0 where none is known.
    pub frequency: R,
    /// Numbers of the body's laws: those of a role begin at [`crate::material::Role::first`], in the order of its declaration.
    pub numbers: [R; NUMBERS],
}

/// Numbers of the formulation as a body has them. Twin: `shaders/lib/body_options.wgsl`
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C)]
pub struct BodyOptions<R> {
    /// Monaghan's viscosity, without dimension: that of its linear and that of its quadratic term.
    pub alpha: R,
    pub beta: R,
    /// Strength of the artificial stress, without dimension.
    pub artificial_epsilon: R,
    /// Strength of the hourglass energy, over Young's modulus.
    pub hourglass: R,
}

impl<R: Real> BodyOptions<R> {
    pub fn map<T: Real>(&self, real: impl Fn(R) -> T) -> BodyOptions<T> {
        let [alpha, beta, artificial_epsilon, hourglass] =
            [self.alpha, self.beta, self.artificial_epsilon, self.hourglass].map(real);
        BodyOptions { alpha, beta, artificial_epsilon, hourglass }
    }
}

/// How two bodies touch. Twin: `ContactPair` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct ContactPair<R> {
    /// Number of the law: of [`contact::Potential::ALL`], [`contact::COLOUR_FIELD`] or [`contact::ZONES`].
    pub law: u32,
    /// n of Strand's repulsive force.
    pub exponent: u32,
    /// For a potential its factor, an energy; for the colour field k, an energy per volume; for zones a force.
    pub strength: R,
    /// Distance at which a potential or colour field ends, or half the side of a zone; 0 where the bodies do not touch.
    pub range: R,
    /// c0 of the colour field.
    pub threshold: R,
    /// Coefficient of friction in the zones.
    pub friction: R,
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

/// How the facets of two bodies, or of a body and an obstacle, touch. Twin: `FacetPair` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C)]
pub struct FacetPair<R> {
    /// Pressure over depth (stress/length); 0 where the two do not touch.
    pub stiffness: R,
    /// Distance R from a facet at which its weight ends; 0 for an obstacle.
    pub range: R,
    /// Sum of weights D_0 below which the energy fades to 0: see [`crate::facet`].
    pub full: R,
    /// Coefficient of friction.
    pub friction: R,
}

impl FacetPair<f64> {
    pub fn map<R: Real>(&self, real: impl Fn(f64) -> R) -> FacetPair<R> {
        let [stiffness, range, full, friction] = [self.stiffness, self.range, self.full, self.friction].map(real);
        FacetPair { stiffness, range, full, friction }
    }
}

/// A rigid body. Twin: `Obstacle` in `shaders/lib/obstacle.wgsl`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C)]
pub struct Obstacle<R> {
    /// Number of the [`crate::obstacle::ObstacleKind`].
    pub kind: u32,
    pub padding: u32,
    /// A point of the obstacle's surface (length). [`crate::obstacle::distance`] takes points relative to this one.
    pub point_x: R,
    pub point_y: R,
    pub point_z: R,
    /// Of length 1; from the point into the obstacle, for a plane its outward normal.
    pub axis_x: R,
    pub axis_y: R,
    pub axis_z: R,
    /// Of length 1, across the axis: the direction of a cylinder, or that in which the first face of a pyramid looks.
    pub turn_x: R,
    pub turn_y: R,
    pub turn_z: R,
    /// Radius of a sphere or cylinder (length).
    pub radius: R,
    /// Cosine and sine of the angle between the axis and the surface of a cone or pyramid.
    pub cosine: R,
    pub sine: R,
}

/// What moves a rigid obstacle. Twin: `Mover` in `shaders/lib/params.wgsl`.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Mover<R> {
    /// Boundary condition that gives its velocity, plus 1; 0 for none.
    pub condition: u32,
    /// 1/mass; 0 for an obstacle whose motion is prescribed.
    pub inverse_mass: R,
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
    /// Length of the next step, a time.
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
    /// Times that the step changed by more than a hundredth.
    pub changes: u32,
    /// Length of the step before, kept from one segment to the next.
    pub held: R,
    /// 1 if the last segment came to its end, 0 if it was broken off after so many steps: then the next one goes on with
    /// the same step.
    pub arrived: u32,
    /// What went wrong, as [`Fault`] numbers it; 0 while all is well.
    pub fault: u32,
    /// Out-of-balance force over the force scale, where equilibrium is sought.
    pub residual: R,
}

impl<R: Real> Clock<R> {
    pub fn of(clock: &Clock<f64>) -> Self {
        Self {
            start: R::of(clock.start),
            elapsed: R::of(clock.elapsed),
            elapsed_carry: R::of(clock.elapsed_carry),
            step: R::of(clock.step),
            duration: R::of(clock.duration),
            steps_left: clock.steps_left,
            steps_done: clock.steps_done,
            running: clock.running,
            rebuild: clock.rebuild,
            lists_built: clock.lists_built,
            changes: clock.changes,
            held: R::of(clock.held),
            arrived: clock.arrived,
            fault: clock.fault,
            residual: R::of(clock.residual),
        }
    }

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
            changes: self.changes,
            held: self.held.f64(),
            arrived: self.arrived,
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
            Fault::NotFinite => "a velocity or stress is no longer a number",
            Fault::Inverted => "a particle's volume fell to zero or below",
            Fault::NoEquilibrium => "no equilibrium was found within quasi_static.most_steps",
        }
    }
}

/// Low bits of a neighbour-list entry: the neighbour; the three bits above: the planes it is mirrored in.
pub const NEIGHBOR_BITS: u32 = 29;
pub const NEIGHBOR_MASK: u32 = (1 << NEIGHBOR_BITS) - 1;
