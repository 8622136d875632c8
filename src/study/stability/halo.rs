//! A Total Lagrangian lattice in a uniform state of deformation and damage, without an end.
//!
//! A box of particles is surrounded by copies of itself, as deep as two supports: forces reach the neighbours'
//! neighbours. Before each force the copies take the displacement of what they copy, less or more what the uniform
//! deformation makes of the way between. All else is the program's own passes.

use super::setting::Setting;
use super::simulate::{Course, Start, samples};
use crate::backend::Backend as _;
use crate::backend::cpu::Cpu;
use crate::pass::{Call, Pass, Stage};
use crate::scene::Scene;
use crate::scene::file::File;
use crate::step;
use crate::study::von_neumann::Damage;
use crate::tensor::Space;
use glam::{DMat3, DVec3};

struct Halo<S: Space> {
    cpu: Cpu<S>,
    /// Each copy, its original, and how much more the copy is displaced.
    copies: Vec<(usize, usize, DVec3)>,
    /// Particles of the box and their places.
    originals: Vec<(usize, DVec3)>,
    calls: Vec<Call>,
}

/// The amplitude at the start and after each part of the course.
pub(super) fn amplitudes<S: Space<Real = f64>>(setting: &Setting, start: &Start, course: Course) -> Result<Vec<f64>, String> {
    let scene = start.scene(setting, course, extended(setting, start.counts))?;
    let mut halo = Halo::<S>::new(&scene, start.counts, setting)?;
    halo.run(&step::begin_run(&scene.method));
    halo.cpu.members[0].clock.step = course.step;
    let mut amplitudes = vec![1.0];
    for _ in 0..samples() {
        for _ in 0..course.steps {
            halo.step();
        }
        amplitudes.push(start.part(halo.velocities()));
    }
    match amplitudes.iter().all(|amplitude| amplitude.is_finite()) {
        true => Ok(amplitudes),
        false => Err(format!("the run of the wave {} fails: it leaves all bounds", start.wave)),
    }
}

/// The setting's scene with a box of so many particles and its copies.
fn extended(setting: &Setting, counts: [usize; 3]) -> File {
    let depth = 2 * (2.0 * setting.smoothing_length() / setting.spacing() - 1e-9).ceil() as usize;
    let mut file = setting.file.clone();
    file.body[0].shape = setting.block(-(depth as i64), counts.map(|count| count + 2 * depth));
    file
}

impl<S: Space<Real = f64>> Halo<S> {
    /// In the setting's state, at the scene's velocities.
    fn new(scene: &Scene, counts: [usize; 3], setting: &Setting) -> Result<Self, String> {
        let (spacing, (deformation, damage)) = (setting.spacing(), setting.state.unwrap_or_default());
        let gradient = deformation - DMat3::IDENTITY;
        let mut cpu = Cpu::<S>::new(scene.state(false));
        cpu.begin_segment(0.0, scene.file.duration, u32::MAX, true)?;
        let place = |i: usize| scene.particles[cpu.members[0].columns.number[i] as usize].position;
        let cell = |x: DVec3| -> [i64; 3] { (x / spacing).round().to_array().map(|number| number as i64) };
        let wrapped = |cell: [i64; 3]| -> [i64; 3] { std::array::from_fn(|axis| cell[axis].rem_euclid(counts[axis] as i64)) };
        let count = scene.particles.len();
        let own = (0..count).filter(|&i| cell(place(i)) == wrapped(cell(place(i))));
        let originals: Vec<(usize, DVec3)> = own.map(|i| (i, place(i))).collect();
        let known: std::collections::HashMap<[i64; 3], usize> = originals.iter().map(|&(i, x)| (cell(x), i)).collect();
        let copy = |i: usize| {
            let original = known[&wrapped(cell(place(i)))];
            (original != i).then(|| (i, original, gradient * (place(i) - place(original))))
        };
        let copies = (0..count).filter_map(copy).collect();
        let uniform: Vec<DVec3> = (0..count).map(|i| gradient * place(i)).collect();
        for (displacement, uniform) in cpu.members[0].columns.displacement.iter_mut().zip(uniform) {
            *displacement = S::vec_from(uniform.to_array());
        }
        // The clock stands: nothing here is prescribed in time.
        let calls = step::step(&scene.method).into_iter().filter(|call| call.pass != Pass::BoundTimeStep).collect();
        let mut halo = Self { cpu, copies, originals, calls };
        halo.weaken(&damage, spacing);
        Ok(halo)
    }

    /// Weakens the distinct bonds, each of which is one of the lattice's.
    fn weaken(&mut self, damage: &Damage, spacing: f64) {
        let state = &mut self.cpu.members[0];
        for row in &mut state.bond_table.rows {
            let left = damage.factor(S::vec_to(row.x), spacing);
            (row.gradient, row.weight) = (row.gradient * left, row.weight * left);
        }
        if !damage.whole_correction {
            let prepared = step::prepare(&state.method);
            let made = |call: &&Call| matches!(call.pass, Pass::CorrectReference | Pass::CorrectQuadratic);
            prepared.iter().filter(made).for_each(|call| call.pass.run(state, call.stage));
        }
    }

    fn run(&mut self, calls: &[Call]) {
        for call in calls {
            self.take(call.pass, call.stage);
        }
    }

    fn step(&mut self) {
        let calls = std::mem::take(&mut self.calls);
        self.run(&calls);
        self.calls = calls;
    }

    fn take(&mut self, pass: Pass, stage: Stage) {
        let state = &mut self.cpu.members[0];
        if pass == Pass::Deform {
            for &(copy, original, more) in &self.copies {
                let columns = &mut state.columns;
                columns.displacement[copy] = columns.displacement[original] + S::vec_from(more.to_array());
                columns.velocity[copy] = columns.velocity[original];
            }
        }
        pass.run(state, stage);
    }

    /// Places and velocities of the box.
    fn velocities(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        let velocity = &self.cpu.members[0].columns.velocity;
        self.originals.iter().map(|&(i, place)| (place, DVec3::from(S::vec_to(velocity[i]))))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::simulate::parsed;
    use super::*;
    use crate::tensor::{Line, Plane, Solid};

    /// Accelerations of the passes beside those of theory for displacements xi sin(k.X + 0.4) on the uniform ones:
    /// the largest difference over the largest acceleration, or over c/dx squared where that is more.
    pub fn error(setting: &Setting, counts: [usize; 3], wave: DVec3, xi: DVec3) -> f64 {
        match setting.dimension {
            1 => error_in::<Line<f64>>(setting, counts, wave, xi),
            2 => error_in::<Plane<f64>>(setting, counts, wave, xi),
            _ => error_in::<Solid<f64>>(setting, counts, wave, xi),
        }
    }

    fn error_in<S: Space<Real = f64>>(setting: &Setting, counts: [usize; 3], wave: DVec3, xi: DVec3) -> f64 {
        let scene = parsed(&extended(setting, counts)).unwrap();
        let mut halo = Halo::<S>::new(&scene, counts, setting).unwrap();
        let uniform = halo.cpu.members[0].columns.displacement.clone();
        let sine = |x: DVec3| (wave.dot(x) + 0.4).sin();
        let amount = 1e-5 * setting.spacing();
        let mut side = |amount: f64| -> Vec<DVec3> {
            halo.cpu.members[0].columns.displacement.clone_from(&uniform);
            for &(i, x) in &halo.originals {
                halo.cpu.members[0].columns.displacement[i] += S::vec_from((xi * (amount * sine(x))).to_array());
            }
            halo.run(&step::begin_run(&scene.method));
            let accelerations = &halo.cpu.members[0].columns.acceleration;
            halo.originals.iter().map(|&(i, _)| DVec3::from(S::vec_to(accelerations[i]))).collect()
        };
        let (plus, minus) = (side(amount), side(-amount));
        let stiffness = setting.waves().stiffness(wave.into());
        let unit = setting.unit_rate() * setting.unit_rate();
        let (mut error, mut largest) = (0.0_f64, unit);
        for (k, &(_, x)) in halo.originals.iter().enumerate() {
            let nonlinear = (plus[k] - minus[k]) / (2.0 * amount);
            error = error.max((nonlinear - stiffness * xi * sine(x)).length());
            largest = largest.max(nonlinear.length());
        }
        error / largest
    }
}
