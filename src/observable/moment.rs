//! One moment of a run on the host, ordered by particle number, and every quantity that can be made of it.

use super::deformation::Deformation;
use crate::backend::Fetched;
use crate::fields::{Field, Set, Type, unit_text};
use crate::material;
use crate::output::{Column, Snapshot};
use crate::scene::Scene;
use crate::scene::file::Units;
use crate::scene::read::hint;
use crate::step;
use glam::DMat3;

/// Fields at one time.
pub struct Moment<'a> {
    pub scene: &'a Scene,
    pub time: f64,
    pub step: u64,
    columns: Fetched,
}

/// What a path may begin with: name, numbers a particle, fields it is made of in the Eulerian formulation.
const QUANTITIES: &[(&str, usize, &[Field])] = &[
    ("position", 3, &[Field::Displacement]),
    ("displacement", 3, &[Field::Displacement]),
    ("velocity", 3, &[Field::Velocity]),
    ("acceleration", 3, &[Field::Acceleration]),
    ("stress", 6, &[Field::VolumetricStrain, Field::DeviatoricStress]),
    ("pressure", 1, &[Field::VolumetricStrain]),
    ("density", 1, &[Field::VolumetricStrain]),
    ("volumetric_strain", 1, &[Field::VolumetricStrain]),
    ("internal_energy", 1, &[Field::InternalEnergy]),
    ("dissipated_energy", 1, &[Field::DissipatedEnergy]),
    ("equivalent_plastic_strain", 1, &[Field::EquivalentPlasticStrain]),
    ("temperature", 1, &[Field::Temperature]),
    ("body", 1, &[]),
    ("constraint", 1, &[]),
];

fn quantity(path: &str) -> Result<&'static (&'static str, usize, &'static [Field]), String> {
    let word = path.split('.').next().unwrap_or(path);
    QUANTITIES.iter().find(|q| q.0 == word).ok_or_else(|| {
        let hint = hint(word, &QUANTITIES.iter().map(|q| q.0).collect::<Vec<_>>());
        format!("reads the unknown field `{path}`{hint}")
    })
}

/// Fields that a scene cannot do without where `fields` are named: in the Total Lagrangian formulation volume,
/// stress and energy follow from the deformation gradient. Only some scenes have a deviator: see [`read`].
pub fn needed(scene: &Scene, fields: &[Field]) -> Vec<Field> {
    let mut list: Vec<Field> = scene.groups().iter().flat_map(|group| needed_by(group, fields)).collect();
    list.sort_unstable();
    list.dedup();
    list
}

/// The same of one group.
fn needed_by(group: &Scene, fields: &[Field]) -> Vec<Field> {
    let lagrangian = group.method.finite_strain();
    let kept = |field: &Field| match field {
        Field::DeviatoricStress => None,
        Field::VolumetricStrain if lagrangian => Some(Field::DisplacementGradient),
        field => Some(*field),
    };
    fields.iter().filter_map(kept).collect()
}

/// The fields of [`needed`], and beside them those that only some scenes have, where this scene has them.
pub fn read(scene: &Scene, fields: &[Field]) -> Vec<Field> {
    let present = scene.fields();
    let mut list = needed(scene, fields);
    if fields.contains(&Field::VolumetricStrain) {
        list.extend([Field::DeviatoricStress, Field::InelasticStrain, Field::DissipatedEnergy]);
        // Elastic energy and velocity together are asked for by the total energy, which counts these energies too.
        if fields.contains(&Field::Velocity) {
            list.extend([Field::HourglassEnergy, Field::ContactEnergy, Field::ObstacleVelocity]);
            if pulled(scene) {
                list.extend([Field::Displacement, Field::ObstacleDisplacement]);
            }
        }
    }
    list.retain(|field| present.contains(field));
    list
}

/// Whether forces that have a potential act on a scene, so that its energy depends on where the particles are.
pub(super) fn pulled(scene: &Scene) -> bool {
    scene.file.quasi_static.is_none()
        && (scene.file.body_force.is_some() || scene.file.boundary.iter().any(|b| b.force.is_some()))
}

/// Fields needed for a path, of those that the scene has.
pub fn fields_of_path(scene: &Scene, path: &str) -> Vec<Field> {
    quantity(path).map_or_else(|_| Vec::new(), |q| read(scene, q.2))
}

/// Refuses what is no whole quantity, or one of a field that no group of the scene has. Particles of the groups that lack the
/// field have no number then.
pub fn check_quantity(scene: &Scene, name: &str) -> Result<(), String> {
    let (word, _, fields) = quantity(name)?;
    if *word != name {
        return Err(format!("reads `{name}`, a part: name the whole `{word}`"));
    }
    let missing: Vec<Option<Field>> = scene.groups().iter().map(|group| missing(scene, group, fields)).collect();
    match missing.first() {
        Some(Some(field)) if missing.iter().all(Option::is_some) => {
            Err(format!("reads {word}, and this scene has no field {}", field.name()))
        }
        _ => Ok(()),
    }
}

/// The first of the fields that a group cannot do without and lacks. Facets and obstacles, and what acts between groups, belong
/// to the whole scene.
fn missing(scene: &Scene, group: &Scene, fields: &[Field]) -> Option<Field> {
    let (own, all) = (step::fields(&group.method), scene.fields());
    let present = |field: &Field| match field.set() {
        Set::Particle if *field != Field::ContactEnergy => own.contains(field),
        _ => all.contains(field),
    };
    needed_by(group, fields).into_iter().find(|field| !present(field))
}

/// Refuses fields that a group lacks to which some of the particles belong.
pub fn check_fields(scene: &Scene, fields: &[Field], particles: &[usize]) -> Result<(), String> {
    for group in scene.groups() {
        let own = group.first_number as usize..group.first_number as usize + group.particles.len();
        if let Some(field) = missing(scene, group, fields).filter(|_| particles.iter().any(|i| own.contains(i))) {
            return Err(match scene.parts.is_empty() {
                true => format!("needs the field {}, which this scene does not name", field.name()),
                false => format!(
                    "needs the field {}, which the group of the body `{}` lacks: take it over other bodies",
                    field.name(),
                    group.bodies[0].name
                ),
            });
        }
    }
    Ok(())
}

/// The fields that a path reads.
pub fn fields_of(path: &str) -> Result<&'static [Field], String> {
    quantity(path).map(|(_, _, fields)| *fields)
}

/// Refuses a path that names no quantity, no part of it, or a field that the scene lacks.
pub fn check_path(scene: &Scene, path: &str) -> Result<(), String> {
    let (word, components, _) = quantity(path)?;
    check_quantity(scene, word)?;
    let snapshot = Snapshot {
        dimension: scene.dimension(),
        positions: vec![[0.0; 3]],
        columns: vec![Column {
            name: (*word).into(),
            unit: String::new(),
            components: *components,
            values: vec![0.0; *components],
        }],
        ..Snapshot::default()
    };
    snapshot.scalar(path).map(|_| ())
}

impl<'a> Moment<'a> {
    /// Sorts what a backend fetched; it must contain the particle numbers.
    pub fn new(scene: &'a Scene, time: f64, step: u64, fetched: &Fetched) -> Self {
        let numbers = &fetched[&Field::Number];
        // Facets and obstacles never change their order; of all else the rows are as the device left them.
        let ordered = |field: Field, column: &[f64]| match field.set() {
            Set::Particle => sorted(column, numbers),
            _ => column.to_vec(),
        };
        let columns = fetched.iter().map(|(&field, column)| (field, ordered(field, column))).collect();
        Self { scene, time, step, columns }
    }

    pub fn count(&self) -> usize {
        self.scene.particles.len()
    }

    /// The particle's numbers of a field, padding included; zeros where the run lacks the field.
    pub(super) fn row(&self, field: Field, i: usize) -> &[f64] {
        static ZEROS: [f64; 12] = [0.0; 12];
        let words = field.kind().words_in(self.scene.dimension());
        self.columns.get(&field).map_or(&ZEROS[..words], |column| &column[i * words..(i + 1) * words])
    }

    pub fn scalar(&self, field: Field, i: usize) -> f64 {
        self.row(field, i)[0]
    }

    /// A particle's number; none where its group lacks the field.
    fn own(&self, field: Field, i: usize) -> f64 {
        let absent = !self.scene.parts.is_empty() && !step::fields(&self.scene.group_of(i).method).contains(&field);
        if absent { f64::NAN } else { self.scalar(field, i) }
    }

    pub fn vector(&self, field: Field, i: usize) -> [f64; 3] {
        debug_assert_eq!(field.kind(), Type::Vec);
        let row = self.row(field, i);
        std::array::from_fn(|k| if k < self.scene.dimension() { row[k] } else { 0.0 })
    }

    /// A second-rank tensor, zero along the axes that the scene lacks.
    pub fn matrix(&self, field: Field, i: usize) -> DMat3 {
        debug_assert_eq!(field.kind(), Type::Mat);
        let (row, dimension) = (self.row(field, i), self.scene.dimension());
        let stride = row.len() / dimension;
        let entry = |j: usize, k: usize| if j < dimension && k < dimension { row[k * stride + j] } else { 0.0 };
        DMat3::from_cols_array_2d(&std::array::from_fn(|k| std::array::from_fn(|j| entry(j, k))))
    }

    pub fn position(&self, i: usize) -> [f64; 3] {
        let u = self.vector(Field::Displacement, i);
        let x = self.scene.particles[i].position.to_array();
        std::array::from_fn(|k| x[k] + u[k])
    }

    /// In a Total Lagrangian scene, what all else follows from.
    fn deformation(&self, i: usize) -> Option<Deformation> {
        (self.scene.group_of(i).method.finite_strain()).then(|| Deformation::of(self, i))
    }

    /// Reference density over density, minus 1.
    pub fn volumetric_strain(&self, i: usize) -> f64 {
        if let Some(deformation) = self.deformation(i) {
            return deformation.volumetric_strain();
        }
        self.scalar(Field::VolumetricStrain, i)
    }

    /// Deviator xx, yy, zz, xy, yz, xz; the axes that the scene lacks carry what the zero trace asks for.
    fn deviator(&self, i: usize) -> [f64; 6] {
        let s = self.row(Field::DeviatoricStress, i);
        match self.scene.dimension() {
            1 => [s[0], -0.5 * s[0], -0.5 * s[0], 0.0, 0.0, 0.0],
            2 => [s[0], s[1], -s[0] - s[1], s[2], 0.0, 0.0],
            _ => std::array::from_fn(|k| s[k]),
        }
    }

    /// Compression positive.
    pub fn pressure(&self, i: usize) -> f64 {
        if let Some(deformation) = self.deformation(i) {
            let s = deformation.stress();
            return -(s[0] + s[1] + s[2]) / 3.0;
        }
        let body = &self.scene.bodies[self.scene.particles[i].body as usize];
        material::pressure(&body.material.row(), self.volumetric_strain(i))
    }

    /// xx, yy, zz, xy, yz, xz; tension positive.
    pub fn stress(&self, i: usize) -> [f64; 6] {
        if let Some(deformation) = self.deformation(i) {
            return deformation.stress();
        }
        let (mut s, p) = (self.deviator(i), self.pressure(i));
        s.iter_mut().take(3).for_each(|x| *x -= p);
        s
    }

    /// Elastic energy of a particle.
    pub fn elastic_energy(&self, i: usize) -> f64 {
        let particle = &self.scene.particles[i];
        if let Some(deformation) = self.deformation(i) {
            return particle.volume * deformation.elastic_energy();
        }
        let body = &self.scene.bodies[particle.body as usize];
        let s = self.deviator(i);
        let square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
        particle.volume * material::elastic_energy(&body.material.row(), self.volumetric_strain(i), square)
    }

    /// The numbers of a quantity of [`QUANTITIES`].
    fn values(&self, word: &str, i: usize) -> Vec<f64> {
        let particle = &self.scene.particles[i];
        match word {
            "position" => self.position(i).to_vec(),
            "displacement" => self.vector(Field::Displacement, i).to_vec(),
            "velocity" => self.vector(Field::Velocity, i).to_vec(),
            "acceleration" => self.vector(Field::Acceleration, i).to_vec(),
            "stress" => self.stress(i).to_vec(),
            "pressure" => vec![self.pressure(i)],
            "density" => vec![self.scene.bodies[particle.body as usize].material.density / (1.0 + self.volumetric_strain(i))],
            "volumetric_strain" => vec![self.volumetric_strain(i)],
            "internal_energy" => vec![self.own(Field::InternalEnergy, i)],
            "dissipated_energy" => vec![self.own(Field::DissipatedEnergy, i)],
            "equivalent_plastic_strain" => vec![self.own(Field::EquivalentPlasticStrain, i)],
            "temperature" => vec![self.own(Field::Temperature, i)],
            "body" => vec![f64::from(particle.body)],
            _ => vec![f64::from(particle.constraint)],
        }
    }

    /// A path's number for each of the particles given.
    pub fn path(&self, path: &str, particles: &[usize]) -> Vec<f64> {
        let word = path.split('.').next().unwrap_or(path);
        let snapshot = self.snapshot_of(&[word.to_string()], particles);
        snapshot.scalar(path).unwrap_or_else(|_| vec![f64::NAN; particles.len()])
    }

    /// What is stored and painted.
    pub fn snapshot(&self, quantities: &[String]) -> Snapshot {
        let all: Vec<usize> = (0..self.count()).collect();
        self.snapshot_of(quantities, &all)
    }

    fn snapshot_of(&self, quantities: &[String], particles: &[usize]) -> Snapshot {
        let column = |name: &String| {
            let (word, components, _) = quantity(name).ok()?;
            let values = particles.iter().flat_map(|&i| self.values(word, i)).collect();
            Some(Column { name: (*word).into(), unit: self.unit(word), components: *components, values })
        };
        Snapshot {
            time: self.time,
            step: self.step,
            dimension: self.scene.dimension(),
            spacing: self.scene.bodies.iter().map(|b| b.spacing).fold(f64::INFINITY, f64::min),
            positions: particles.iter().map(|&i| self.position(i)).collect(),
            columns: quantities.iter().filter_map(column).collect(),
        }
    }

    /// Unit of a quantity in words; nothing where the scene has no dimensions.
    fn unit(&self, word: &str) -> String {
        let names @ [length, _, time] = self.scene.unit_names();
        match (word, self.scene.file.units) {
            (_, Units::Dimensionless) => String::new(),
            ("stress" | "pressure", Units::Si) => "Pa".into(),
            ("stress" | "pressure", Units::MillimetreTonneSecond) => "MPa".into(),
            ("velocity", _) => format!("{length}/{time}"),
            ("acceleration", _) => format!("{length}/{time}^2"),
            ("position" | "displacement", _) => length.into(),
            ("density", _) => unit_text([-3, 1, 0], names),
            ("internal_energy" | "dissipated_energy", _) => unit_text(Field::InternalEnergy.unit(), names),
            _ => String::new(),
        }
    }
}

/// Rows of a column put in the order of the particles' numbers.
fn sorted(column: &[f64], numbers: &[f64]) -> Vec<f64> {
    let words = column.len() / numbers.len().max(1);
    let mut out = vec![0.0; column.len()];
    for (row, &number) in numbers.iter().enumerate() {
        let place = number as usize * words;
        out[place..place + words].copy_from_slice(&column[row * words..(row + 1) * words]);
    }
    out
}
