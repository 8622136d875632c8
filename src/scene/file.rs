//! A scene exactly as it is typed: one struct per TOML table, nothing computed, nothing checked beyond
//! words and types. [`super::resolve`] turns it into what the solver sees.
//!
//! Lengths, times and masses are in the scene's own consistent units (`units`).

use super::material::MaterialTable;
use super::packing::Packing;
use super::shape::{Coordinates, Shape};
use super::study::Groups;
use crate::contact::Potential;
use crate::contact::zones::{Form, Normals};
use crate::method::{ArtificialForm, Density, Descent, Formulation, Gradient, Integrator};
use crate::method::{Configuration, Deformation, GapForm, VelocityGradient};
use crate::smoothing::Smoothing;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The whole file.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// One line that says what happens.
    pub title: String,
    /// Where the scene comes from: document, section, equation.
    #[serde(default)]
    pub source: String,
    pub dimension: usize,
    #[serde(default)]
    pub units: Units,
    /// Particle spacing of every body that names none.
    pub spacing: f64,
    pub duration: f64,
    /// True for a scene, or in a variant, that is small enough to run with the tests.
    #[serde(default)]
    pub ci: bool,
    pub body: Vec<BodyTable>,
    pub material: BTreeMap<String, MaterialTable>,
    /// The formulation of all bodies that name none.
    #[serde(default)]
    pub formulation: FormulationTable,
    /// `[formulation.NAME]`, for the bodies that name it.
    #[serde(default)]
    pub formulations: BTreeMap<String, FormulationTable>,
    #[serde(default)]
    pub contact: Vec<ContactTable>,
    #[serde(default)]
    pub obstacle: Vec<ObstacleTable>,
    #[serde(default)]
    pub boundary: Vec<Boundary>,
    #[serde(default)]
    pub symmetry: Vec<Symmetry>,
    /// Lengths of a periodic box, one for each axis; 0 leaves an axis open.
    #[serde(default)]
    pub periodic: Option<Vec<f64>>,
    /// Acceleration of every free particle.
    #[serde(default)]
    pub body_force: Option<Vec<f64>>,
    #[serde(default)]
    pub kick: Vec<Kick>,
    #[serde(default)]
    pub time: Time,
    /// Equilibrium at each of a number of load steps, instead of motion in time.
    #[serde(default)]
    pub quasi_static: Option<QuasiStatic>,
    #[serde(default)]
    pub watch: Watch,
    #[serde(default)]
    pub output: Output,
    #[serde(default)]
    pub observe: BTreeMap<String, Observe>,
    #[serde(default)]
    pub expect: BTreeMap<String, Expect>,
    #[serde(default)]
    pub study: Study,
    /// Named sets of changes; see [`super::read`]. Kept as typed: each is merged into the file and read again.
    #[serde(default)]
    pub variant: BTreeMap<String, toml::Table>,
}

impl File {
    /// Reach of the neighbour list beyond the kernel's, over h.
    pub fn list_margin(&self) -> f64 {
        let usual = if self.dimension == 3 { 0.08 } else { 0.15 };
        self.formulation.list_margin.unwrap_or(usual)
    }

    /// Whether a body yields.
    pub fn yields(&self, body: &BodyTable) -> bool {
        self.material.get(&body.material).is_some_and(MaterialTable::yields)
    }

    /// Time between frames, 0 for none: a tenth of the duration unless given, but no less than a load step.
    pub fn frames(&self) -> f64 {
        let least = self.quasi_static.as_ref().map_or(0.0, |q| self.duration / f64::from(q.load_steps));
        self.output.frames.unwrap_or((self.duration / 10.0).max(least))
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
pub enum Units {
    #[default]
    #[serde(rename = "SI")]
    Si,
    #[serde(rename = "mm-t-s")]
    MillimetreTonneSecond,
    #[serde(rename = "dimensionless")]
    Dimensionless,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyTable {
    pub name: String,
    /// Name that copies share.
    #[serde(skip)]
    pub group: Option<String>,
    /// More bodies of the same kind, on a grid.
    pub copies: Option<Copies>,
    pub shape: Shape,
    /// Unless given a lattice, or fitted to the shape's boundary where the body touches others: see `src/scene/surface.rs`.
    pub packing: Option<Packing>,
    /// Particle spacing, if not the scene's.
    pub spacing: Option<f64>,
    /// A point of the lattice. Unless given the lattice is centred in the box around the shape, so that a box of whole multiples of
    /// the spacing is filled to its faces.
    pub anchor: Option<Coordinates>,
    /// Facets of its surface to a spacing, in each direction, where it touches by a gap or an obstacle. 1 unless given; 4 in the plane
    /// and 2 in space where something sharp is touched: a facet is met at its middle, so that an edge between two would come late.
    pub facets: Option<u32>,
    pub material: String,
    /// Name of a `[formulation.NAME]`; the plain `[formulation]` unless given.
    pub formulation: Option<String>,
    pub velocity: Option<Coordinates>,
    /// Angular velocity about `spin_axis` (z unless given) through `spin_center`.
    #[serde(default)]
    pub spin: f64,
    pub spin_axis: Option<Coordinates>,
    pub spin_center: Option<Coordinates>,
    /// Initial velocity field by name, beside `velocity` and `spin`.
    pub motion: Option<Motion>,
    /// Unstressed offset of the packed points, amplitude sin(wave_vector . x + phase): a flaw of shape.
    pub flaw: Option<Wave>,
    /// Volume over unstressed volume at the start.
    pub relative_volume: Option<f64>,
    /// Deviatoric stress at the start: xx, yy, zz, xy, yz, xz.
    pub deviatoric_stress: Option<[f64; 6]>,
}

/// `count` bodies along each axis, `apart` from each other, about the place of the one that is typed.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Copies {
    pub count: Vec<u32>,
    /// Width of the gaps.
    pub apart: Coordinates,
}

/// A velocity field that varies over a body.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// v = gradient x, rows of the matrix.
    Gradient(Vec<Vec<f64>>),
    /// v = amplitude sin(wave_vector . x + phase)
    Wave(Wave),
    /// First mode of a clamped beam.
    Cantilever(Cantilever),
    /// A spin that grows from the root of a column to its end.
    Twist(Twist),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wave {
    pub amplitude: Coordinates,
    pub wave_vector: Coordinates,
    #[serde(default)]
    pub phase: f64,
}

/// v = tip f(s)/f(1), f the first clamped-free mode, s the distance from the root along the axis over the length, 0
/// behind it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cantilever {
    pub root: Coordinates,
    pub axis: Coordinates,
    pub length: f64,
    /// Velocity of the free end.
    pub tip: Coordinates,
}

/// v = rate sin(pi s/2) axis x (x - root), s the distance from the root along the axis over the length, 0 behind it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Twist {
    pub root: Coordinates,
    pub axis: Coordinates,
    pub length: f64,
    /// Angular velocity at the end.
    pub rate: f64,
}

/// Extra velocity for the one particle nearest to a point.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kick {
    pub at: Coordinates,
    pub velocity: Coordinates,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FormulationTable {
    /// `total_lagrangian` unless given, if the laws of all its bodies are of that formulation, else `eulerian`.
    pub kind: Formulation,
    pub smoothing: Smoothing,
    /// h over the particle spacing.
    pub smoothing_length: f64,
    pub density: Density,
    /// Plain in the Eulerian formulation unless given, adjoint in the Total Lagrangian.
    pub gradient: Option<Gradient>,
    /// Strength of the hourglass energy of the Total Lagrangian formulation, over Young's modulus; 0.5 unless
    /// given, 0.1 where a body yields.
    pub hourglass: Option<f64>,
    /// Total Lagrangian on the CPU: true looks each bond up among the distinct bonds, which is three times as fast; false
    /// evaluates the kernel anew at each bond, which takes less memory where particles lie on no lattice. A GPU always
    /// evaluates anew.
    pub bond_table: Option<bool>,
    /// Corrected kernel: Liu's full correction, or the bare kernel; true unless given.
    pub correction: Option<bool>,
    /// Corrected kernel: where kernel sums run; `current` unless given.
    pub configuration: Option<Configuration>,
    /// Corrected kernel: how the deformation gradient is found; `evolved` unless given, in the reference
    /// configuration `reference`.
    pub deformation: Option<Deformation>,
    /// Corrected kernel: which velocities the velocity gradient sums; `difference` unless given.
    pub velocity_gradient: Option<VelocityGradient>,
    pub viscosity: Option<Viscosity>,
    /// Weight of Monaghan's XSPH: particles move with the smoothed velocity.
    pub xsph: Option<f64>,
    /// Weight of the same average used as a filter of the velocity itself: dissipates, kept for comparison.
    pub velocity_filter: Option<f64>,
    pub artificial_stress: Option<ArtificialStress>,
    /// Integrate the energy equation.
    pub internal_energy: bool,
    /// Add up what viscosity, of the formulation or of a Maxwell body, turns into heat, and plastic work.
    pub dissipated_energy: bool,
    /// Reach of the neighbour list beyond the kernel's, over h. In space more pairs pay for it than in the
    /// plane, so there it is smaller unless given.
    pub list_margin: Option<f64>,
    /// Entries that a particle's list can hold; from the packing unless given.
    pub list_capacity: Option<u32>,
}

impl Default for FormulationTable {
    fn default() -> Self {
        Self {
            kind: Formulation::default(),
            smoothing: Smoothing::CubicSpline,
            smoothing_length: 1.3,
            density: Density::default(),
            gradient: None,
            hourglass: None,
            bond_table: None,
            correction: None,
            configuration: None,
            deformation: None,
            velocity_gradient: None,
            viscosity: None,
            xsph: None,
            velocity_filter: None,
            artificial_stress: None,
            internal_energy: false,
            dissipated_energy: false,
            list_margin: None,
            list_capacity: None,
        }
    }
}

impl FormulationTable {
    /// Strength of the hourglass energy. Where a body yields they bear less of it: at 0.5 a flat punch asks for 11 % more than
    /// the slip lines do, at 0.1 for 9 %.
    pub fn hourglass(&self, yields: bool) -> f64 {
        let usual = match self.kind {
            Formulation::TotalLagrangian if yields => 0.1,
            Formulation::TotalLagrangian => 0.5,
            _ => 0.0,
        };
        self.hourglass.unwrap_or(usual)
    }

    pub fn gradient(&self) -> Gradient {
        let usual = if self.kind == Formulation::TotalLagrangian { Gradient::Adjoint } else { Gradient::Plain };
        self.gradient.unwrap_or(usual)
    }
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Viscosity {
    pub alpha: f64,
    /// Quadratic coefficient; 2 alpha unless given, as in Fuller (2.60).
    pub beta: Option<f64>,
    /// Softens the denominator: r^2 + softening h^2.
    #[serde(default)]
    pub softening: f64,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArtificialStress {
    #[serde(default)]
    pub form: ArtificialForm,
    pub epsilon: f64,
    #[serde(default = "default_exponent")]
    pub exponent: u32,
    /// Spacing at which the kernel is one in f = W(r)/W(spacing).
    #[serde(default)]
    pub spacing: ArtificialSpacing,
}

fn default_exponent() -> u32 {
    4
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ArtificialSpacing {
    /// The particle spacing.
    #[default]
    Initial,
    /// Mean distance to the neighbours of a particle inside the lattice: Strand's other reading.
    Mean,
    /// A length.
    Given(f64),
}

/// What acts between two bodies.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactTable {
    pub between: [String; 2],
    /// 1: as if one body; 0: not at all; between: weakened. Eulerian only; 1 unless given.
    pub kernel: Option<f64>,
    /// Repulsion of particles that come close; a body may be named twice, to touch itself.
    pub potential: Option<PairPotential>,
    /// Surfaces keep apart by their facets.
    pub gap: Option<SurfaceGap>,
    /// Energy of the other body's colour.
    pub colour_field: Option<ColourField>,
    /// Forces along the surface's normals.
    pub zones: Option<Zones>,
    /// Nothing acts between the two, and that is meant: they pass through each other without a warning.
    #[serde(default)]
    pub none: bool,
    /// Bonded where they share a face, each of its own material. Total Lagrangian only.
    #[serde(default)]
    pub tie: bool,
}

impl ContactTable {
    /// Some law is named beside the kernel.
    pub fn touches(&self) -> bool {
        self.potential.is_some() || self.colour_field.is_some() || self.zones.is_some()
    }
}

/// U = (k/2) sum V_a <c_a - c0>^2: see `src/contact/colour_field.rs`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColourField {
    /// k over the lowest Young's modulus of the scene.
    pub stiffness: f64,
    /// c0, between 0 and 1: a half where a particle lies on the other body's surface.
    pub threshold: f64,
    /// Support of the kernel, in spacings.
    pub range: f64,
}

/// Fuller's particle-to-surface contact: see `src/contact/zones.rs`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zones {
    /// R, half the side of a zone, in spacings.
    pub radius: f64,
    /// Force at which (4.2) is 1, over the lower Young's modulus times a spacing (in space its square); 1 as Fuller has it.
    #[serde(default = "one")]
    pub stiffness: f64,
    #[serde(default)]
    pub form: Form,
    #[serde(default)]
    pub normals: Normals,
    /// A particle lies on the surface with this share of the most neighbours, or less.
    #[serde(default = "default_surface")]
    pub surface: f64,
    /// And at a corner with this share: there zones have several normals.
    #[serde(default = "default_corner")]
    pub corner: f64,
    /// mu of (4.3).
    #[serde(default)]
    pub friction: f64,
}

fn one() -> f64 {
    1.0
}

fn default_surface() -> f64 {
    0.75
}

fn default_corner() -> f64 {
    0.5
}

/// Energy of facets that are in another body's surface: see `src/facet.rs`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceGap {
    #[serde(default)]
    pub form: GapForm,
    /// Pressure over depth, as a multiple of Young's modulus over the spacing; 2 unless given.
    #[serde(default = "default_stiffness")]
    pub stiffness: f64,
    /// Distance over which the other surface is smoothed, in spacings.
    #[serde(default = "default_range")]
    pub range: f64,
    /// Coefficient of friction.
    #[serde(default)]
    pub friction: f64,
}

fn default_stiffness() -> f64 {
    2.0
}

fn default_range() -> f64 {
    2.0
}

/// What an obstacle fills; `axis` points from the apex into the obstacle.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ObstacleShape {
    /// The half space behind a plane with an outward normal.
    Plane { point: Coordinates, normal: Coordinates },
    /// A disc in 2D.
    Sphere { center: Coordinates, radius: f64 },
    /// 3D: round, without ends.
    Cylinder { center: Coordinates, axis: Coordinates, radius: f64 },
    /// A wedge in 2D; half angle in degrees.
    Cone { apex: Coordinates, axis: Coordinates, half_angle: f64 },
    /// 3D: three faces at 65.27 degrees from the axis, of which one looks along y if the axis is z; turned about the axis
    /// by `turn` degrees.
    Berkovich {
        apex: Coordinates,
        axis: Coordinates,
        #[serde(default)]
        turn: f64,
    },
}

/// A rigid surface that bodies cannot enter.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObstacleTable {
    pub name: String,
    pub shape: ObstacleShape,
    /// Velocity: at the start if it has a mass, else prescribed; at rest unless given.
    pub velocity: Option<Coordinates>,
    /// Times and factors of a prescribed velocity, linear between, constant outside.
    pub course: Option<Vec<[f64; 2]>>,
    /// Mass of an obstacle that the bodies push; without one its motion is prescribed. No obstacle turns.
    pub mass: Option<f64>,
    /// Pressure over depth, over Young's modulus over the spacing of the body that it touches.
    #[serde(default = "default_stiffness")]
    pub stiffness: f64,
    /// Coefficient of friction.
    #[serde(default)]
    pub friction: f64,
    /// Bodies that it touches; all unless given.
    pub against: Option<Vec<String>>,
}

/// U = strength phi(r/range) for each pair of particles.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairPotential {
    pub law: Potential,
    /// Strength over Young's modulus times the volume of a cube of one spacing.
    pub stiffness: f64,
    /// In spacings.
    pub range: f64,
    /// n of the law `repulsive`; 4 unless given. Its stiffness is k times density^2 over Young's modulus.
    pub exponent: Option<u32>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Boundary {
    pub name: Option<String>,
    pub select: Select,
    /// Held at rest along all axes, or along the axes marked true.
    pub fixed: Option<Fixed>,
    /// Prescribed velocity; axes with "free" stay free.
    pub velocity: Option<Vec<Axis>>,
    /// Force on the whole selection, shared by mass.
    pub force: Option<Coordinates>,
    /// Times and factors of the velocity or force, linear between, constant outside.
    pub course: Option<Vec<[f64; 2]>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub enum Fixed {
    All(bool),
    Axes(Vec<bool>),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub enum Axis {
    Value(f64),
    Word(FreeWord),
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FreeWord {
    Free,
}

/// Particles of a body, inside a shape, or both.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Select {
    pub body: Option<String>,
    pub inside: Option<Shape>,
}

/// A plane that the material cannot cross and along which it slips: its mirror image acts beyond it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Symmetry {
    pub point: Coordinates,
    /// Points into the material.
    pub normal: Coordinates,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Time {
    pub integrator: Integrator,
    /// Time step over h/c, where c is that of the present deformation. At finite strain a step is never longer than 0.8 of what
    /// the integrator bears at the highest frequency.
    pub cfl: f64,
    /// A fixed time step, in place of the one that `cfl` gives.
    pub step: Option<f64>,
}

impl Default for Time {
    fn default() -> Self {
        Self { integrator: Integrator::Leapfrog, cfl: 0.3, step: None }
    }
}

/// What a run keeps an eye on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Watch {
    /// What happens when the energy drifts: see `src/run/watch.rs`.
    pub energy: EnergyWatch,
    /// Drift, over the largest energy of the run, at which it stops; 0.1 unless given.
    pub energy_drift: Option<f64>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EnergyWatch {
    /// A warning at 1 % of drift, and an end at `energy_drift`.
    #[default]
    Stop,
    /// A warning, and no end.
    Warn,
    /// Energies are not summed.
    Off,
}

/// The scene's duration is pseudo-time. Prescribed velocities, integrated over a load step, move what they hold at
/// its start; forces and body force have their value at its end, and grow linearly from 0 over the duration
/// where no course says otherwise.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuasiStatic {
    #[serde(default)]
    pub method: Descent,
    pub load_steps: u32,
    /// Largest out-of-balance force on what is free, over the force scale: see `src/pass/bound_residual.rs`.
    #[serde(default = "default_residual")]
    pub residual: f64,
    /// Steps of the descent after which a load step is given up.
    #[serde(default = "default_most_steps")]
    pub most_steps: u32,
}

fn default_residual() -> f64 {
    1e-5
}

fn default_most_steps() -> u32 {
    100_000
}

#[derive(Debug, Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Output {
    /// Time between rows of the series; a hundredth of the duration unless given.
    pub series: Option<f64>,
    /// Time between pictures and stored particle states; a tenth of the duration unless given; 0 for none.
    pub frames: Option<f64>,
    /// Fields in the particle file, beside displacement and velocity.
    pub fields: Vec<String>,
    pub picture: Picture,
}

impl Default for Output {
    fn default() -> Self {
        Self { series: None, frames: None, fields: vec!["stress".into(), "density".into()], picture: Picture::default() }
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Picture {
    pub field: String,
    pub range: Option<[f64; 2]>,
    pub width: u32,
    pub height: u32,
    /// Direction from which a 3D scene is seen.
    pub eye: Option<[f64; 3]>,
    /// Corners of what is shown, in every picture; unless given the bodies at the start, and more where one leaves that.
    pub bounds: Option<[Coordinates; 2]>,
}

impl Default for Picture {
    fn default() -> Self {
        Self { field: "pressure".into(), range: None, width: 1200, height: 900, eye: None, bounds: None }
    }
}

/// A number followed through time, or found from such a series. `kind` is a word of `lithosph list`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Observe {
    pub kind: String,
    /// Body that the number is taken over; all bodies unless given.
    pub body: Option<String>,
    /// Obstacle that the number belongs to.
    pub obstacle: Option<String>,
    /// Shape that the particles lie in at the start.
    pub inside: Option<Shape>,
    /// Field by path: "velocity.x", "stress.yy", "pressure" …
    pub field: Option<String>,
    /// Where a probe sits at the start.
    pub at: Option<Coordinates>,
    /// Interpolate with the kernel at the fixed point instead of following the nearest particle.
    pub interpolate: bool,
    /// Component: "x", "y", "z" or "magnitude".
    pub axis: Option<String>,
    /// Another observable that this one is found from.
    pub of: Option<String>,
    /// A second one: the divisor of a ratio, what is taken off a swinging series, the other coordinate of a trace.
    pub over: Option<String>,
    /// Times between which the observable is found.
    pub between: Option<[f64; 2]>,
    /// Distance in spacings, speed, depth at which an indenter first touches, or whatever the kind takes.
    pub distance: Option<f64>,
    /// Two meanings, by kind. For a period, for `value_at` and for `zone`: a value, in the unit of the series or field, that
    /// is crossed, reached or exceeded. For the depth of an indentation's contact: a factor without unit, by which
    /// load/stiffness times it is the depth that the surface sinks outside the contact, 0.75 unless given.
    pub level: Option<f64>,
    /// Radius of a ball that indents.
    pub radius: Option<f64>,
    /// Cross-section of a pointed indenter at distance 1 from its apex, 24.5 for Berkovich's.
    pub section: Option<f64>,
    /// Loads, over the largest, between which unloading is fitted; 0.5 and 0.95 unless given.
    pub shares: Option<[f64; 2]>,
    /// Correction of the reduced modulus for an indenter that is not round; 1 unless given.
    pub beta: Option<f64>,
}

/// What must come out.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Expect {
    /// What the row states: the truth, which must come out, unless given.
    pub kind: Statement,
    /// The truth.
    pub value: Option<f64>,
    /// Largest distance from the truth, at most twice the error seen; of all kinds but the truth, from what was `seen`.
    pub tolerance: Option<f64>,
    /// The tolerance is a fraction of the scale, and so is the distance from a reference.
    pub relative: bool,
    /// What errors are a fraction of, a number or a word. Unless given it is the value; of a value 0 the largest number of the
    /// run's own series; of a reference its peak.
    pub scale: Option<Scale>,
    pub reference: Option<String>,
    /// Column of the abscissa (time, or position for a profile) and of the ordinate, or of both coordinates of a trace.
    pub columns: Option<Vec<String>>,
    pub norm: Option<Norm>,
    /// The number that comes out where it is not the truth; with a `reference`, the distance from it. The row holds within
    /// `tolerance` of it, so that getting better is noticed as getting worse is.
    pub seen: Option<f64>,
    /// Range that the source itself gives for the truth, in place of `value` and `tolerance`.
    pub between: Option<[f64; 2]>,
    /// Why another number than the truth is seen, or why there is no truth.
    pub because: Option<String>,
    /// How one number is made of a series: final unless given.
    pub statistic: Option<Statistic>,
    pub source: String,
    /// The one variant for which the expectation holds; all unless given, `none` for the scene without a variant.
    pub variant: Option<String>,
}

impl Expect {
    /// What a relative tolerance is a fraction of, and 1 of one that is not; none where only the run knows.
    pub fn unit(&self) -> Option<f64> {
        match (self.relative, self.scale, self.value.or(self.seen)) {
            (false, ..) => Some(1.0),
            (true, Some(Scale::Number(scale)), _) => Some(scale),
            (true, None, Some(value)) if self.reference.is_none() && value != 0.0 => Some(value.abs()),
            _ => None,
        }
    }
}

/// What a row of the scene's expectations states.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Statement {
    /// The truth comes out.
    #[default]
    Truth,
    /// The method fails here as its source or theory says, and the scene is there to show it.
    Failure,
    /// The truth is known and this program misses it: an error of ours.
    Shortfall,
    /// No truth is at hand: what was seen is held.
    Pinned,
}

/// What errors are a fraction of.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Scale {
    Number(f64),
    Word(ScaleWord),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ScaleWord {
    /// Largest magnitude of the reference.
    Peak,
    /// Mean magnitude of the reference.
    Mean,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Norm {
    Max,
    Rms,
    Final,
    Phase,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Statistic {
    Final,
    First,
    Min,
    Max,
    Mean,
    /// Largest distance from the first value.
    Drift,
}

impl Statistic {
    pub const ALL: [Self; 6] = [Self::Final, Self::First, Self::Min, Self::Max, Self::Mean, Self::Drift];

    /// Word in a scene.
    pub fn word(self) -> &'static str {
        match self {
            Self::Final => "final",
            Self::First => "first",
            Self::Min => "min",
            Self::Max => "max",
            Self::Mean => "mean",
            Self::Drift => "drift",
        }
    }

    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|statistic| statistic.word() == word)
    }
}

/// What the studies of `lithosph study` vary.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Study {
    /// Under `[study.accuracy]` one group, or one under each `[[study.accuracy]]`.
    pub accuracy: Option<Groups>,
    /// Uniform state in which `study stability` finds a Total Lagrangian body.
    pub stability: Option<Stability>,
}

/// A body of finite strain starts a run unstressed; its stability is asked for in a state of its own.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Stability {
    /// Rows of the deformation gradient; the unit tensor unless given.
    pub deformation: Option<Vec<Vec<f64>>>,
    /// By how much bonds with a part along each axis are weakened, from 0, whole, to 1, cut.
    pub damage: Option<Coordinates>,
    /// True keeps the gradient correction of whole bonds; false makes it from the damaged ones.
    pub whole_correction: bool,
}
