//! What a scene says about the lattice whose stability is asked for.

use crate::material::Law;
use crate::method::{self, ArtificialForm, Density, Formulation};
use crate::scene::Scene;
use crate::scene::file::{self, ArtificialSpacing, File};
use crate::scene::packing::Packing;
use crate::scene::shape::{Coordinates, Shape};
use crate::study::von_neumann::{
    ArtificialStress, Damage, Elastic, Equations, Gradient, Lagrangian, Lattice, Medium, Mode, Viscous, Waves, by_growth,
    periodic_wave_vectors,
};
use glam::DMat3;
use rayon::prelude::*;

/// The scene's first body as an infinite square lattice in a uniform state. A body that yields is taken for elastic.
#[derive(Debug, Clone)]
pub struct Setting {
    /// The scene without all that a lattice lacks: boundaries, contacts, loads, observables.
    pub(super) file: File,
    pub(super) dimension: usize,
    spacing: f64,
    smoothing_length: f64,
    sound_speed: f64,
    theory: Theory,
    viscous: Option<Viscous>,
    /// F and the damage of a Total Lagrangian body.
    pub(super) state: Option<(DMat3, Damage)>,
}

#[derive(Debug, Clone)]
enum Theory {
    Eulerian(Box<Equations>),
    Lagrangian(Box<Lagrangian>),
}

impl Setting {
    /// # Errors
    /// One sentence where the theory lacks what the scene names.
    pub fn new(scene: &Scene) -> Result<Self, String> {
        let body = &scene.bodies[0];
        let f = &scene.file.formulation;
        let refuse = |reason: &str| Err(format!("{}: {reason}", scene.label()));
        let typed = scene.file.study.stability.clone().unwrap_or_default();
        let lattice = Lattice {
            dimension: scene.dimension(),
            spacing: body.spacing,
            smoothing: f.smoothing,
            smoothing_length: body.smoothing_length,
        };
        let (theory, state) = match f.kind {
            Formulation::CorrectedKernel => return refuse("stability is that of the formulations eulerian and total_lagrangian"),
            Formulation::Eulerian if f.density == Density::Summation => {
                return refuse("the theory of stability has the density from continuity: formulation.density must be continuity");
            }
            Formulation::Eulerian if typed.deformation.is_some() || typed.damage.is_some() => {
                return refuse(
                    "study.stability has the state of a Total Lagrangian body; an Eulerian one has relative_volume and deviatoric_stress",
                );
            }
            Formulation::Eulerian if body.material.pressure != Some(Law::Linear) => {
                return refuse(
                    "the theory of stability has a pressure linear in the density: the material's pressure must be `linear`",
                );
            }
            Formulation::Eulerian => (Theory::Eulerian(Box::new(eulerian(scene, lattice))), None),
            Formulation::TotalLagrangian if body.material.has_memory() => {
                return refuse("the theory of stability is that of elastic laws: `st_venant_kirchhoff` and `neo_hookean`");
            }
            Formulation::TotalLagrangian => {
                let (deformation, damage) =
                    uniform(&typed, scene.dimension()).map_err(|why| format!("{}: {why}", scene.label()))?;
                let (gradient, hourglass) = (f.gradient(), scene.bodies[0].options.hourglass);
                let elastic = Elastic { body: body.numbers(), gradient, hourglass, deformation, damage };
                (Theory::Lagrangian(Box::new(Lagrangian::new(lattice, &elastic))), Some((deformation, damage)))
            }
        };
        let viscous = f.viscosity.as_ref().filter(|typed| typed.alpha > 0.0).map(|typed| {
            let (deformation, damage) = state.unwrap_or((DMat3::IDENTITY, Damage::default()));
            Viscous::new(&lattice, deformation, &damage, typed.alpha * body.material.sound_speed(), typed.softening)
        });
        let (spacing, smoothing_length) = (body.spacing, body.smoothing_length);
        let (file, sound_speed) = (lattice_file(scene), body.material.sound_speed());
        Ok(Self { file, dimension: scene.dimension(), spacing, smoothing_length, sound_speed, theory, viscous, state })
    }

    /// The discrete equations of the lattice, linearised.
    pub fn waves(&self) -> &dyn Waves {
        match &self.theory {
            Theory::Eulerian(equations) => &**equations,
            Theory::Lagrangian(equations) => &**equations,
        }
    }

    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Distance of nearest neighbours: in the present state of an Eulerian body, in the reference configuration of a
    /// Total Lagrangian one.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    pub fn smoothing_length(&self) -> f64 {
        self.smoothing_length
    }

    /// c of longitudinal waves in the unstressed body.
    pub fn sound_speed(&self) -> f64 {
        self.sound_speed
    }

    /// c/dx, over which rates and frequencies are shown.
    pub fn unit_rate(&self) -> f64 {
        self.sound_speed / self.spacing
    }

    /// Motions of a wave with the scene's viscosity, by falling growth rate and rising frequency.
    pub fn modes(&self, k: [f64; 3]) -> Vec<Mode> {
        let mut modes = self.waves().modes(k);
        // What rounding leaves of a wave that swings or is neutral: the root of the eigenvalue's.
        let rounding = 1e-6 * self.unit_rate();
        modes.iter_mut().filter(|mode| mode.rate < rounding).for_each(|mode| mode.rate = 0.0);
        if let Some(viscous) = &self.viscous {
            modes.iter_mut().for_each(|mode| *mode = viscous.damped(k, *mode));
            by_growth(&mut modes);
        }
        modes
    }

    /// The fastest growing motion of a wave; of stable ones the slowest.
    pub fn mode(&self, k: [f64; 3]) -> Mode {
        self.modes(k).swap_remove(0)
    }

    /// The fastest growing of some waves, and how it moves.
    pub fn fastest(&self, wave_vectors: &[[f64; 3]]) -> Option<([f64; 3], Mode)> {
        let modes = wave_vectors.par_iter().map(|&k| (k, self.mode(k)));
        modes.max_by(|a, b| a.1.rate.total_cmp(&b.1.rate))
    }

    /// The run dissipates.
    pub fn dissipates(&self) -> bool {
        self.viscous.is_some() || self.filters()
    }

    /// Velocities are filtered, which the theory leaves out.
    pub fn filters(&self) -> bool {
        self.file.formulation.velocity_filter.is_some_and(|weight| weight > 0.0)
    }

    /// Waves of a periodic box with so many particles along each axis.
    pub fn wave_vectors(&self, cells: usize) -> Vec<[f64; 3]> {
        periodic_wave_vectors(std::array::from_fn(|axis| if axis < self.dimension { cells } else { 1 }), self.spacing)
    }

    /// A body that fills the box from half a spacing below `first` particles to as much above the `last`.
    pub(super) fn block(&self, first: i64, counts: [usize; 3]) -> Shape {
        let low = (first as f64 - 0.5) * self.spacing;
        let corner = |of: &dyn Fn(usize) -> f64| Coordinates((0..self.dimension).map(of).collect());
        Shape::Block { min: corner(&|_| low), max: corner(&|axis| low + counts[axis] as f64 * self.spacing) }
    }
}

fn eulerian(scene: &Scene, lattice: Lattice) -> Equations {
    let (body, f) = (&scene.bodies[0], &scene.file.formulation);
    let mut medium =
        Medium::at_volume(body.relative_volume, body.material.density, body.material.bulk_modulus, body.material.shear_modulus);
    medium.deviator = body.deviator;
    let gradient = match f.gradient() {
        method::Gradient::Plain => Gradient::Plain,
        method::Gradient::Adjoint => Gradient::Adjoint,
        method::Gradient::Corrected | method::Gradient::Quadratic => Gradient::Corrected,
    };
    let artificial = f.artificial_stress.as_ref().map_or(ArtificialStress::None, |typed| {
        let (epsilon, exponent, spacing) = (typed.epsilon, f64::from(typed.exponent), scene.artificial_spacing);
        match typed.form {
            ArtificialForm::Scalar => ArtificialStress::Scalar { epsilon, exponent, spacing },
            ArtificialForm::Principal => ArtificialStress::Principal { epsilon, exponent, spacing },
        }
    });
    Equations::new(lattice, medium, artificial, gradient).with_xsph(f.xsph.unwrap_or(0.0))
}

/// F and the damage that are typed.
fn uniform(typed: &file::Stability, dimension: usize) -> Result<(DMat3, Damage), String> {
    let mut deformation = DMat3::IDENTITY;
    for (row, line) in typed.deformation.iter().flatten().enumerate() {
        for (column, &value) in line.iter().enumerate().take(dimension) {
            deformation.col_mut(column)[row.min(2)] = value;
        }
    }
    let shaped = |rows: &Vec<Vec<f64>>| rows.len() == dimension && rows.iter().all(|row| row.len() == dimension);
    if !typed.deformation.as_ref().is_none_or(shaped) {
        return Err(format!("study.stability.deformation has {dimension} rows of {dimension} numbers"));
    }
    if !(deformation.is_finite() && deformation.determinant() > 0.0) {
        return Err("study.stability.deformation must have a positive determinant".into());
    }
    let along = typed.damage.as_ref().map_or([0.0; 3], |damage| damage.vector().to_array());
    if typed.damage.as_ref().is_some_and(|damage| damage.0.len() != dimension) || along.iter().any(|d| !(0.0..=1.0).contains(d)) {
        return Err(format!("study.stability.damage has {dimension} numbers from 0, whole, to 1, cut"));
    }
    Ok((deformation, Damage { along, whole_correction: typed.whole_correction }))
}

/// The scene with its first body alone, and nothing that acts on it.
fn lattice_file(scene: &Scene) -> File {
    let mut file = scene.file.clone();
    file.body.truncate(1);
    let body = &mut file.body[0];
    // A node of the lattice is the origin, about which the blocks of particles are counted.
    let origin = Some(Coordinates::from([0.0; 3]));
    (body.copies, body.packing, body.spacing, body.anchor) = (None, Some(Packing::Square), None, origin);
    (body.velocity, body.spin, body.motion, body.flaw) = (None, 0.0, None, None);
    file.spacing = scene.bodies[0].spacing;
    let material = body.material.clone();
    file.material.retain(|name, _| *name == material);
    file.contact.clear();
    file.obstacle.clear();
    file.boundary.clear();
    file.symmetry.clear();
    file.kick.clear();
    (file.periodic, file.body_force, file.quasi_static) = (None, None, None);
    file.observe.clear();
    file.expect.clear();
    file.variant.clear();
    file.study = file::Study::default();
    file.output = file::Output { frames: Some(0.0), fields: Vec::new(), ..file::Output::default() };
    file.output.picture.field = "velocity.magnitude".into();
    let formulation = &mut file.formulation;
    (formulation.internal_energy, formulation.dissipated_energy, formulation.list_capacity) = (false, false, None);
    if let Some(typed) = &mut formulation.artificial_stress {
        typed.spacing = ArtificialSpacing::Given(scene.artificial_spacing);
    }
    if formulation.kind == Formulation::TotalLagrangian {
        (formulation.list_margin, formulation.bond_table) = (None, Some(true));
    }
    file
}
