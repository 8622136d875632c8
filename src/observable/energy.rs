//! Energies of the selected particles.

use super::moment::pulled;
use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;
use crate::scene::Scene;
use rayon::prelude::*;

fn sum(observer: &Observer, of: impl Fn(usize) -> f64) -> f64 {
    observer.particles.iter().map(|&i| of(i)).sum()
}

fn kinetic(moment: &Moment, i: usize) -> f64 {
    let v = moment.vector(Field::Velocity, i);
    0.5 * moment.scene.mass(i) * v.iter().map(|c| c * c).sum::<f64>()
}

/// Kinetic energy of the obstacles that are free.
fn obstacles(moment: &Moment) -> f64 {
    let free = moment.scene.obstacles.iter().enumerate().filter(|(_, obstacle)| obstacle.inverse_mass > 0.0);
    free.map(|(k, obstacle)| {
        let v = moment.vector(Field::ObstacleVelocity, k);
        0.5 * v.iter().map(|c| c * c).sum::<f64>() / obstacle.inverse_mass
    })
    .sum()
}

/// Energy that is not stored in the material: of contact and of the hourglass term.
fn stray(moment: &Moment, i: usize) -> f64 {
    moment.scalar(Field::HourglassEnergy, i) + moment.scalar(Field::ContactEnergy, i)
}

/// Heat that the run has added up for a particle.
fn heat(moment: &Moment, i: usize) -> f64 {
    moment.scene.mass(i) * moment.scalar(Field::DissipatedEnergy, i)
}

/// Acceleration of a particle by the body force and by a boundary's force, where these stay the same for the whole run and so
/// have a potential. Equilibrium is sought under loads that grow: there they have none.
fn steady_pull(scene: &Scene, i: usize) -> [f64; 3] {
    let mut pull = body_force(scene);
    let held = scene.particles[i].constraint as usize;
    if held > 0 && scene.file.quasi_static.is_none() {
        let condition = &scene.constraints[held - 1];
        let factor = condition.steady_factor().unwrap_or(0.0);
        for (axis, sum) in pull.iter_mut().enumerate().filter(|(axis, _)| !condition.prescribed[*axis]) {
            *sum += condition.vector[axis] * factor;
        }
    }
    pull
}

fn body_force(scene: &Scene) -> [f64; 3] {
    let typed = scene.file.body_force.as_deref().filter(|_| scene.file.quasi_static.is_none()).unwrap_or_default();
    std::array::from_fn(|axis| typed.get(axis).copied().unwrap_or(0.0))
}

fn along(pull: [f64; 3], way: [f64; 3]) -> f64 {
    pull.iter().zip(way).map(|(p, w)| p * w).sum()
}

/// Potential of the steady forces on a particle: 0 where it was packed.
fn potential(moment: &Moment, i: usize) -> f64 {
    if !pulled(moment.scene) {
        return 0.0;
    }
    -moment.scene.mass(i) * along(steady_pull(moment.scene, i), moment.vector(Field::Displacement, i))
}

/// Potential of the body force on the obstacles that are free.
fn obstacles_potential(moment: &Moment) -> f64 {
    let (pull, free) = (body_force(moment.scene), moment.scene.obstacles.iter().enumerate());
    let free = free.filter(|(_, obstacle)| obstacle.inverse_mass > 0.0);
    free.map(|(k, obstacle)| -along(pull, moment.vector(Field::ObstacleDisplacement, k)) / obstacle.inverse_mass).sum()
}

/// The energies of a whole scene at one moment.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Energies {
    /// Of particles and of the obstacles that are free.
    pub kinetic: f64,
    /// What the material stores.
    pub elastic: f64,
    /// Of contacts and of the hourglass terms.
    pub stray: f64,
    /// Turned into heat, where the scene adds that up.
    pub heat: f64,
    /// Of body force and of boundaries' forces that stay the same: 0 where everything was packed, so minus their work.
    pub potential: f64,
}

/// Particles that are summed one after the other: the sum is the same on any number of threads.
const BLOCK: usize = 4096;

impl Energies {
    /// Fields that the sum reads, of those that the scene has.
    pub fn fields(scene: &Scene) -> Vec<Field> {
        super::moment::read(scene, TOTAL.fields)
    }

    pub fn of(moment: &Moment) -> Self {
        let starts: Vec<usize> = (0..moment.count()).step_by(BLOCK).collect();
        let block = |&first: &usize| {
            let particles = first..(first + BLOCK).min(moment.count());
            particles.fold(Self::default(), |sum, i| sum.plus(Self::of_particle(moment, i)))
        };
        let blocks: Vec<Self> = starts.par_iter().map(block).collect();
        let free = Self { kinetic: obstacles(moment), potential: obstacles_potential(moment), ..Self::default() };
        blocks.into_iter().fold(free, Self::plus)
    }

    fn of_particle(moment: &Moment, i: usize) -> Self {
        Self {
            kinetic: kinetic(moment, i),
            elastic: moment.elastic_energy(i),
            stray: stray(moment, i),
            heat: heat(moment, i),
            potential: potential(moment, i),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            kinetic: self.kinetic + other.kinetic,
            elastic: self.elastic + other.elastic,
            stray: self.stray + other.stray,
            heat: self.heat + other.heat,
            potential: self.potential + other.potential,
        }
    }

    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.stray + self.heat + self.potential
    }
}

pub const HOURGLASS: ObservableKind = ObservableKind {
    word: "hourglass_energy",
    about: "energy of what the deformation gradient does not see (Total Lagrangian)",
    needs: &[],
    fields: &[Field::HourglassEnergy],
    value: Value::Series(|moment, observer| sum(observer, |i| moment.scalar(Field::HourglassEnergy, i))),
};

pub const CONTACT: ObservableKind = ObservableKind {
    word: "contact_energy",
    about: "energy of pairs that touch",
    needs: &[],
    fields: &[Field::ContactEnergy],
    value: Value::Series(|moment, observer| sum(observer, |i| moment.scalar(Field::ContactEnergy, i))),
};

pub const KINETIC: ObservableKind = ObservableKind {
    word: "kinetic_energy",
    about: "sum of m v^2/2",
    needs: &[],
    fields: &[Field::Velocity],
    value: Value::Series(|moment, observer| sum(observer, |i| kinetic(moment, i))),
};

pub const ELASTIC: ObservableKind = ObservableKind {
    word: "elastic_energy",
    about: "sum of V0 (K (e - ln(1 + e)) + (1 + e) S:S/(4 mu)); of V0 psi in the Total Lagrangian formulation",
    needs: &[],
    fields: &[Field::VolumetricStrain],
    value: Value::Series(|moment, observer| sum(observer, |i| moment.elastic_energy(i))),
};

pub const INTERNAL: ObservableKind = ObservableKind {
    word: "internal_energy",
    about: "sum of m u, u from the energy equation (formulation.internal_energy)",
    needs: &[],
    fields: &[Field::InternalEnergy],
    value: Value::Series(|moment, observer| sum(observer, |i| moment.scene.mass(i) * moment.scalar(Field::InternalEnergy, i))),
};

pub const DISSIPATED: ObservableKind = ObservableKind {
    word: "dissipated_energy",
    about: "heat made by viscosity so far, that of a Maxwell body too, and plastic work (formulation.dissipated_energy)",
    needs: &[],
    fields: &[Field::DissipatedEnergy],
    value: Value::Series(|moment, observer| sum(observer, |i| moment.scene.mass(i) * moment.scalar(Field::DissipatedEnergy, i))),
};

pub const TOTAL: ObservableKind = ObservableKind {
    word: "total_energy",
    about: "kinetic and elastic energy, that of hourglass terms and contacts, less the work of the body force and of boundaries' forces without a course, the dissipated one where the scene adds it up; of all particles also that of free obstacles",
    needs: &[],
    fields: &[Field::Velocity, Field::VolumetricStrain],
    value: Value::Series(|moment, observer| {
        if observer.particles.len() == moment.count() {
            return Energies::of(moment).total();
        }
        sum(observer, |i| Energies::of_particle(moment, i).total())
    }),
};

pub const SPEED: ObservableKind = ObservableKind {
    word: "rms_speed",
    about: "sqrt(2 kinetic energy/mass): Strand's total velocity",
    needs: &[],
    fields: &[Field::Velocity],
    value: Value::Series(|moment, observer| {
        let mass = sum(observer, |i| moment.scene.mass(i));
        (2.0 * sum(observer, |i| kinetic(moment, i)) / mass).sqrt()
    }),
};
