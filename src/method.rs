//! The words of the physics and numerics: what a scene may choose, and a [`Method`], the choice that it makes.
//!
//! Everything that follows from a choice reads it here: fields, passes, tables, and the shaders' text through [`FLAGS`].

use crate::contact;
use crate::contact::zones;
use crate::material::{Law, Role};
use crate::smoothing::Smoothing;
use serde::Deserialize;

/// In which configuration the sums run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// Neighbours and kernels where the particles are now; stress from rates.
    #[default]
    Eulerian,
    /// Neighbours and kernels of the reference configuration, found once; stress from the deformation gradient.
    TotalLagrangian,
    /// Fully corrected kernels and F as a state of its own: Shutov & Klyuchantsev 2019.
    CorrectedKernel,
}

impl Formulation {
    /// Word in a scene.
    pub fn word(self) -> &'static str {
        match self {
            Self::Eulerian => "eulerian",
            Self::TotalLagrangian => "total_lagrangian",
            Self::CorrectedKernel => "corrected_kernel",
        }
    }
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Density {
    /// From the divergence of the velocity, Fuller (2.21).
    #[default]
    Continuity,
    /// From the particles' masses, Fuller (2.22): wrong at free surfaces.
    Summation,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Gradient {
    /// Bare kernel gradient.
    #[default]
    Plain,
    /// The velocity gradient is exact for linear fields; the force is the plain one.
    Corrected,
    /// The force is the adjoint of the corrected velocity gradient: keeps energy and angular momentum.
    Adjoint,
    /// Total Lagrangian: exact for quadratic displacements, for thin parts. Needs three layers of particles.
    Quadratic,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ArtificialForm {
    /// epsilon |P|/rho^2 where the pressure is tensile.
    Scalar,
    /// On tensile principal stresses: Gray, Monaghan & Swift 2001.
    #[default]
    Principal,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Kick-drift-kick: one force a step, second order, symplectic for elastic bodies.
    Leapfrog,
    /// Heun.
    Rk2,
    /// Shu & Osher's third order: each stage an average of Euler steps.
    SspRk3,
    /// The classical fourth order.
    Rk4,
    /// Omelyan, Mryglod & Folk 2002: symplectic, fourth order, four forces a step.
    Pefrl,
}

impl Integrator {
    /// Word in a scene.
    pub fn word(self) -> &'static str {
        match self {
            Self::Leapfrog => "leapfrog",
            Self::Rk2 => "rk2",
            Self::SspRk3 => "ssp_rk3",
            Self::Rk4 => "rk4",
            Self::Pefrl => "pefrl",
        }
    }
}

/// How equilibrium is found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Descent {
    /// Fast inertial relaxation engine: Bitzek et al. 2006.
    #[default]
    Fire,
    /// Velocities are set to zero at each peak of the kinetic energy: Cundall 1982.
    KineticDamping,
}

/// Which terms of the force between facets act.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GapForm {
    /// All terms, together the derivative of an energy, so that energy and both momenta are kept.
    #[default]
    Potential,
    /// Only the terms along the normals: neither energy nor angular momentum is kept.
    AlongNormals,
}

/// Where kernel sums run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Configuration {
    #[default]
    Current,
    Reference,
}

/// How the deformation gradient is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Deformation {
    /// From displacements, (8).
    Reference,
    /// From the velocity gradient, (9).
    Evolved,
}

/// Which velocities the velocity gradient (6) sums.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VelocityGradient {
    /// v_b - v_a
    #[default]
    Difference,
    /// v_b, as printed: right only where the shape functions sum to one.
    Printed,
}

/// The options of the formulation [`Formulation::CorrectedKernel`] that a scene chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CorrectedKernel {
    pub correction: bool,
    pub configuration: Configuration,
    pub deformation: Deformation,
    pub velocity_gradient: VelocityGradient,
}

impl CorrectedKernel {
    pub fn current(self) -> bool {
        self.configuration == Configuration::Current
    }

    pub fn evolved(self) -> bool {
        self.deformation == Deformation::Evolved
    }

    /// Whether forces are summed over the present positions but F over the reference positions, so that the neighbours of
    /// the reference configuration must be kept beside the present list.
    pub fn keeps_gradients(self) -> bool {
        self.current() && !self.evolved()
    }
}

/// Which physics and numerics a run is made of; decides its fields, its passes and its shaders' text.
#[derive(Debug, Clone, PartialEq)]
pub struct Method {
    pub dimension: usize,
    pub formulation: Formulation,
    /// No group's own method, but that of what acts between groups of different formulations: see [`crate::step`].
    pub between: bool,
    /// Options of the corrected kernel's formulation; None in the others.
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
    /// Bodies differ in numbers of the formulation.
    pub body_options: bool,
    /// Some pair of bodies does not act as one through the kernel.
    pub coupling: bool,
    /// Bonds of the reference configuration join particles of different bodies.
    pub tied: bool,
    pub constraints: bool,
    pub symmetry: bool,
    pub periodic: bool,
    pub body_force: bool,
    /// Energy against motions that the deformation gradient does not see.
    pub hourglass: bool,
    /// The CPU path keeps the kernel values of the distinct bonds.
    pub bond_table: bool,
    /// Laws of contact between particles: potentials, colour field, zones.
    pub contact: contact::Laws,
    /// Surfaces of bodies keep apart by their facets, and by which terms of the force; None where they do not.
    pub gap: Option<GapForm>,
    /// Rigid obstacles stand in the way.
    pub obstacles: bool,
    /// Facets feel Coulomb friction on other surfaces or on obstacles.
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

/// The method of one elastic body in the plane in the Eulerian formulation, without any option.
impl Default for Method {
    fn default() -> Self {
        Self {
            dimension: 2,
            formulation: Formulation::Eulerian,
            between: false,
            corrected_kernel: None,
            laws: vec![Law::Linear, Law::Elastic],
            smoothing: Smoothing::CubicSpline,
            integrator: Integrator::Leapfrog,
            quasi_static: None,
            density: Density::Continuity,
            gradient: Gradient::Plain,
            shear: true,
            many_bodies: false,
            body_options: false,
            coupling: false,
            tied: false,
            constraints: false,
            symmetry: false,
            periodic: false,
            body_force: false,
            hourglass: false,
            bond_table: false,
            contact: contact::Laws::default(),
            gap: None,
            obstacles: false,
            friction: false,
            viscosity: false,
            xsph: false,
            velocity_filter: false,
            artificial_stress: None,
            internal_energy: false,
            dissipated_energy: false,
            compensated: false,
        }
    }
}

/// Whether a word of [`FLAGS`] holds for a method.
pub type Condition = fn(&Method) -> bool;

/// Every word that `#if` may ask for in the shaders, and when it holds.
pub const FLAGS: &[(&str, Condition)] = &[
    ("line", |m| m.dimension == 1),
    ("plane", |m| m.dimension == 2),
    ("solid", |m| m.dimension == 3),
    ("fire", |m| m.quasi_static == Some(Descent::Fire)),
    ("finite_strain", |m| m.finite_strain()),
    ("list_follows", |m| m.list_follows()),
    ("staged", |m| m.staged()),
    ("correction", |m| m.correction()),
    ("current", |m| m.current()),
    ("evolved", |m| m.evolved()),
    ("kept_gradients", |m| m.kept_gradients()),
    ("difference", |m| m.corrects(|sums| sums.velocity_gradient == VelocityGradient::Difference)),
    ("hourglass", |m| m.hourglass),
    ("contact", |m| m.contact.with_energy()),
    ("potentials", |m| !m.contact.potentials.is_empty()),
    ("colour_field", |m| m.contact.colour_field),
    ("zones_printed", |m| m.zoned(|zones| zones.form == zones::Form::Printed)),
    ("zones_all", |m| m.zoned(|zones| zones.normals == zones::Normals::All)),
    ("zones_friction", |m| m.zones_friction()),
    ("facets", |m| m.facets()),
    ("gap", |m| m.gap.is_some()),
    ("along_normals", |m| m.along_normals()),
    ("obstacles", |m| m.obstacles),
    ("friction", |m| m.friction),
    ("listed_again", |m| m.listed_again()),
    ("memory", |m| m.memory()),
    ("plastic", |m| m.plastic()),
    ("heated", |m| m.heated()),
    ("quasi_static", |m| m.quasi_static.is_some()),
    ("shear", |m| m.shears()),
    ("many_bodies", |m| m.many_bodies),
    ("body_options", |m| m.body_options),
    ("coupling", |m| m.coupling),
    ("tied", |m| m.tied),
    ("constraints", |m| m.constraints),
    ("symmetry", |m| m.symmetry),
    ("periodic", |m| m.periodic),
    ("body_force", |m| m.body_force),
    ("viscosity", |m| m.viscosity),
    ("xsph", |m| m.xsph),
    ("artificial_stress", |m| m.artificial_stress.is_some()),
    ("scalar_form", |m| m.scalar_form()),
    ("principal_form", |m| m.principal_form()),
    ("continuity", |m| m.continuity()),
    ("correct_rate", |m| m.corrects_rate()),
    ("quadratic_gradient", |m| m.quadratic_gradient()),
    ("adjoint", |m| m.adjoint()),
    ("internal_energy", |m| m.internal_energy),
    ("dissipated_energy", |m| m.dissipated_energy),
    ("dissipated_power", |m| m.dissipated_power()),
    ("pair_velocity", |m| m.pair_velocity()),
    ("pair_volume", |m| m.pair_volume()),
    ("compensated", |m| m.compensated),
];

impl Method {
    /// Whether stress follows from the deformation gradient.
    pub fn finite_strain(&self) -> bool {
        self.formulation != Formulation::Eulerian
    }
    /// Whether the neighbour list is made anew as the particles move.
    pub fn list_follows(&self) -> bool {
        (self.eulerian() && !self.between) || self.corrected_kernel.is_some_and(|options| options.current())
    }
    /// Whether any list, of neighbours or of contacts, is made anew as the particles move.
    pub fn listed_again(&self) -> bool {
        self.list_follows() || self.contact.any() || self.gap.is_some()
    }
    /// Whether bodies touch each other or obstacles by facets of their surfaces.
    pub fn facets(&self) -> bool {
        self.gap.is_some() || self.obstacles
    }
    /// Whether a step is made of Runge-Kutta stages.
    pub fn staged(&self) -> bool {
        !matches!(self.integrator, Integrator::Leapfrog | Integrator::Pefrl)
    }
    /// Whether kicks add up the heat of viscosity from its rate. Laws that relax or yield add up their own heat.
    pub fn dissipated_power(&self) -> bool {
        self.dissipated_energy && self.viscosity
    }
    /// Whether stress at finite strain depends on more than the deformation gradient, by a law that remembers.
    pub fn memory(&self) -> bool {
        self.finite_strain() && self.laws.iter().any(|law| law.has_memory())
    }
    /// Whether particles have a temperature.
    pub fn heated(&self) -> bool {
        self.laws.iter().any(|law| law.role() == Role::Heat)
    }
    /// Whether some law yields.
    pub fn plastic(&self) -> bool {
        self.laws.iter().any(|law| law.yields())
    }
    pub fn eulerian(&self) -> bool {
        self.formulation == Formulation::Eulerian
    }
    /// Deviatoric stress is a state of its own.
    pub fn shears(&self) -> bool {
        self.eulerian() && self.shear
    }
    /// Volumetric strain is a state of its own.
    pub fn continuity(&self) -> bool {
        self.eulerian() && self.density == Density::Continuity
    }
    /// Gradients are corrected in some way.
    pub fn corrects_rate(&self) -> bool {
        self.gradient != Gradient::Plain
    }
    pub fn adjoint(&self) -> bool {
        self.gradient == Gradient::Adjoint
    }
    pub fn quadratic_gradient(&self) -> bool {
        self.gradient == Gradient::Quadratic
    }
    pub fn scalar_form(&self) -> bool {
        self.artificial_stress == Some(ArtificialForm::Scalar)
    }
    pub fn principal_form(&self) -> bool {
        self.artificial_stress == Some(ArtificialForm::Principal)
    }
    /// The force needs the velocities of pairs.
    pub fn pair_velocity(&self) -> bool {
        self.viscosity || self.internal_energy
    }
    /// The force needs the present volumes of pairs.
    pub fn pair_volume(&self) -> bool {
        self.viscosity || self.adjoint()
    }
    /// Kernels are corrected by shape functions.
    pub fn correction(&self) -> bool {
        self.corrects(|sums| sums.correction)
    }
    /// Corrected kernels, summed where the particles are now.
    pub fn current(&self) -> bool {
        self.corrects(CorrectedKernel::current)
    }
    /// Corrected kernels, with the deformation gradient as a state of its own.
    pub fn evolved(&self) -> bool {
        self.corrects(CorrectedKernel::evolved)
    }
    pub fn kept_gradients(&self) -> bool {
        self.corrects(CorrectedKernel::keeps_gradients)
    }
    pub fn zones_friction(&self) -> bool {
        self.zoned(|zones| zones.friction)
    }
    pub fn along_normals(&self) -> bool {
        self.gap == Some(GapForm::AlongNormals)
    }
    /// Words of [`FLAGS`] whose condition holds, in their order.
    pub fn flags(&self) -> Vec<&'static str> {
        FLAGS.iter().filter(|(_, holds)| holds(self)).map(|(word, _)| *word).collect()
    }

    /// Whether kernels are corrected, and with this option.
    fn corrects(&self, has: fn(CorrectedKernel) -> bool) -> bool {
        self.corrected_kernel.is_some_and(has)
    }

    /// Whether some bodies touch by zones, and with this option.
    fn zoned(&self, has: fn(zones::Options) -> bool) -> bool {
        self.contact.zones.is_some_and(has)
    }
}
