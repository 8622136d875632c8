//! Energies of the selected particles.

use super::{Moment, ObservableKind, Observer, Value};
use crate::fields::Field;

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
    about: "kinetic and elastic energy, that of hourglass terms and contacts, the dissipated one where the scene adds it up; of all particles also that of free obstacles",
    needs: &[],
    fields: &[Field::Velocity, Field::VolumetricStrain],
    value: Value::Series(|moment, observer| {
        let own = sum(observer, |i| {
            let heat = moment.scene.mass(i) * moment.scalar(Field::DissipatedEnergy, i);
            kinetic(moment, i) + moment.elastic_energy(i) + heat + stray(moment, i)
        });
        let all = observer.particles.len() == moment.count();
        own + if all { obstacles(moment) } else { 0.0 }
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
