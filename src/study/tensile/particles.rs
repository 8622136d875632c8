//! Swegle's test as a small loop over particles, for what no pass of the program does: the work of the repulsive force,
//! partitions of unity, a repulsive force in compression. Fluid only, in units of the spacing and the speed of sound.
//!
//! The equations are those of the passes (density by continuity, leapfrog with the strain rate at the half step), so
//! that without those additions it follows a run of the program.

mod forces;

use super::case::Case;
use super::partition::{Equation, Partition};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// What is added to the plain method, besides the case's repulsive force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rule {
    /// Bond viscosity of particles that approach: C_L, C_Q and the softening epsilon_0 (Johnson 1996).
    pub viscosity: Option<[f64; 3]>,
    pub partition: Option<Partition>,
    /// Kernels of the reference positions and the nominal stress instead (Total Lagrangian).
    pub lagrangian: bool,
}

/// Sums of one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// In dx/c.
    pub time: f64,
    /// Root mean square speed, in c: the thesis's total velocity.
    pub speed: f64,
    /// Kinetic energy, in rho0 c^2 dx^D.
    pub kinetic: f64,
    /// Work of the repulsive force along the way so far, the same unit.
    pub work: f64,
    /// The same as the thesis sums it: length of the force times length of the step.
    pub work_of_lengths: f64,
}

/// A block of particles whose border, as wide as the kernel reaches, is held.
pub struct Block {
    case: Case,
    rule: Rule,
    mass: f64,
    start: Vec<DVec3>,
    pub position: Vec<DVec3>,
    pub velocity: Vec<DVec3>,
    density: Vec<f64>,
    held: Vec<bool>,
    acceleration: Vec<DVec3>,
    /// The repulsive force's share of the acceleration.
    pub repulsion: Vec<DVec3>,
    lists: Vec<Vec<u32>>,
    /// Positions of which the lists were made.
    listed: Vec<DVec3>,
    time: f64,
    work: f64,
    work_of_lengths: f64,
}

/// By how much lists reach beyond the kernel, in spacings.
const MARGIN: f64 = 0.5;

/// How far sums reach.
fn reach(case: Case, rule: Rule) -> f64 {
    2.0 * case.ratio * rule.partition.map_or(1.0, |partition| partition.scale.max(1.0))
}

/// Layers that are held on each side.
pub fn border(case: Case, rule: Rule) -> usize {
    reach(case, rule).ceil() as usize
}

impl Block {
    /// `side` particles along each axis, an odd number; the one in the middle is kicked along x by `kick` (in c).
    pub fn new(case: Case, rule: Rule, side: usize, kick: f64) -> Self {
        let along = |axis: usize| if axis < case.dimension { 0..side } else { 0..1 };
        let point = |x: usize, y: usize, z: usize| DVec3::new(x as f64, y as f64, z as f64);
        let start: Vec<DVec3> =
            along(0).flat_map(|x| along(1).flat_map(move |y| along(2).map(move |z| point(x, y, z)))).collect();
        let border = border(case, rule) as f64;
        let inner = border..=(side as f64 - 1.0 - border);
        let held = start.iter().map(|x| (0..case.dimension).any(|axis| !inner.contains(&x[axis]))).collect();
        let mut velocity = vec![DVec3::ZERO; start.len()];
        velocity[start.len() / 2].x = kick;
        let mut block = Self {
            case,
            rule,
            mass: 1.0 / case.volume,
            position: start.clone(),
            velocity,
            density: vec![1.0 / case.volume; start.len()],
            held,
            acceleration: Vec::new(),
            repulsion: Vec::new(),
            lists: Vec::new(),
            listed: Vec::new(),
            start,
            time: 0.0,
            work: 0.0,
            work_of_lengths: 0.0,
        };
        block.accelerate();
        block
    }

    /// Gives the free particles of a line the velocity of a standing wave, m half waves long, instead of a kick.
    #[must_use]
    pub fn standing(mut self, m: usize, amplitude: f64) -> Self {
        let border = border(self.case, self.rule);
        let free = self.start.len() - 2 * border;
        for a in 0..self.start.len() {
            let phase = PI * m as f64 * (self.start[a].x + 1.0 - border as f64) / (free + 1) as f64;
            self.velocity[a] = if self.held[a] { DVec3::ZERO } else { DVec3::X * (amplitude * phase.sin()) };
        }
        self
    }

    fn list(&mut self) {
        let moved = |(now, then): (&DVec3, &DVec3)| now.distance_squared(*then) > (0.5 * MARGIN).powi(2);
        if !self.listed.is_empty() && !self.position.iter().zip(&self.listed).any(moved) {
            return;
        }
        let (position, reach) = (&self.position, (reach(self.case, self.rule) + MARGIN).powi(2));
        let near = |a: usize| {
            let others = (0..position.len() as u32).filter(move |&b| b as usize != a);
            others.filter(|&b| position[a].distance_squared(position[b as usize]) < reach).collect()
        };
        self.lists = (0..position.len()).into_par_iter().map(near).collect();
        self.listed = position.clone();
    }

    fn kick(&mut self, dt: f64) {
        for a in (0..self.velocity.len()).filter(|&a| !self.held[a]) {
            self.velocity[a] += self.acceleration[a] * dt;
        }
    }

    fn drift(&mut self, dt: f64) {
        for a in 0..self.position.len() {
            self.position[a] += self.velocity[a] * dt;
        }
    }

    fn strain(&mut self, dt: f64) {
        if self.rule.lagrangian {
            return;
        }
        self.list();
        let unity = self.unity();
        let divergence = |a: usize| -> f64 {
            let term = |b: usize| {
                let x = self.position[a] - self.position[b];
                let r = x.length();
                let slope = self.slope(Equation::StrainRate, unity.as_ref().map(|u| u[a]), r);
                self.mass / self.density[b] * (self.velocity[b] - self.velocity[a]).dot(x / r) * slope
            };
            self.lists[a].iter().map(|&b| term(b as usize)).sum()
        };
        let rates: Vec<f64> = (0..self.position.len()).into_par_iter().map(divergence).collect();
        for (density, rate) in self.density.iter_mut().zip(rates) {
            // Exact for a constant rate, as the volume of the pass.
            *density *= (-rate * dt).exp();
        }
    }

    /// One step of leapfrog.
    pub fn step(&mut self, dt: f64) {
        let (before, force) = (self.position.clone(), self.repulsion.clone());
        self.kick(0.5 * dt);
        self.drift(0.5 * dt);
        self.strain(dt);
        self.drift(0.5 * dt);
        self.accelerate();
        self.kick(0.5 * dt);
        self.time += dt;
        self.count_work(&before, &force);
    }

    /// Moves the particles to given places by one step, whatever the forces are, and counts what the repulsive one does.
    pub fn lead(&mut self, to: impl Fn(DVec3) -> DVec3, dt: f64) {
        let (before, force) = (self.position.clone(), self.repulsion.clone());
        for a in 0..self.start.len() {
            self.velocity[a] = (to(self.start[a]) - self.position[a]) / dt;
        }
        self.drift(0.5 * dt);
        self.strain(dt);
        self.drift(0.5 * dt);
        self.accelerate();
        self.time += dt;
        self.count_work(&before, &force);
    }

    fn count_work(&mut self, before: &[DVec3], force: &[DVec3]) {
        for (a, old) in force.iter().enumerate() {
            let step = self.position[a] - before[a];
            self.work += 0.5 * self.mass * (*old + self.repulsion[a]).dot(step);
            self.work_of_lengths += self.mass * self.repulsion[a].length() * step.length();
        }
    }

    pub fn row(&self) -> Row {
        let square: f64 = self.velocity.iter().map(|v| v.length_squared()).sum();
        Row {
            time: self.time,
            speed: (square / self.velocity.len() as f64).sqrt(),
            kinetic: 0.5 * self.mass * square,
            work: self.work,
            work_of_lengths: self.work_of_lengths,
        }
    }

    /// Rows at equal intervals, from the start to the end.
    pub fn run(&mut self, duration: f64, rows: usize, dt: f64) -> Vec<Row> {
        let steps = (duration / (rows as f64 * dt)).ceil() as usize;
        let dt = duration / (rows * steps) as f64;
        let mut found = vec![self.row()];
        for _ in 0..rows {
            (0..steps).for_each(|_| self.step(dt));
            found.push(self.row());
        }
        found
    }
}

/// Slope of ln speed over the rows from a time on, by least squares.
pub fn growth(rows: &[(f64, f64)], from: f64) -> f64 {
    let late: Vec<(f64, f64)> = rows.iter().filter(|r| r.0 >= from && r.1 > 0.0).map(|&(t, v)| (t, v.ln())).collect();
    let n = late.len() as f64;
    let (t, y) = (late.iter().map(|r| r.0).sum::<f64>() / n, late.iter().map(|r| r.1).sum::<f64>() / n);
    late.iter().map(|r| (r.0 - t) * (r.1 - y)).sum::<f64>() / late.iter().map(|r| (r.0 - t).powi(2)).sum::<f64>()
}
