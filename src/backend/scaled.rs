//! Units inside. A cell of atoms in metres, or a planet, has volumes and kernel gradients that f32 cannot hold. Such a run is
//! stepped in units of its own, powers of two, so that no digit changes: the tables are scaled before they reach the machine,
//! and what comes back is scaled on its way.

use super::{Backend, Fetched, Saved};
use crate::contact::{COLOUR_FIELD, ZONES};
use crate::fields::{Field, Type, Unit};
use crate::material::{Law, Role};
use crate::pass::Call;
use crate::rows::{Body, Clock};
use crate::scene::Scene;
use crate::state::State;
use crate::tensor::{Real, Space};

/// Powers of ten beyond which a number made of lengths, times and stresses is too near the ends of f32, 1e-38 and 3e38.
const ROOM: f64 = 25.0;

/// One unit inside, in the scene's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    length: f64,
    time: f64,
    stress: f64,
    dimension: i32,
}

impl Units {
    /// Units in which the numbers of the scene are near 1, if f32 may not hold them as they are.
    pub fn of(scene: &Scene) -> Option<Self> {
        let bodies = || scene.bodies.iter();
        let length = bodies().map(|body| body.spacing).fold(f64::INFINITY, f64::min);
        let stress = bodies().map(|body| body.material.contact_modulus()).fold(0.0, f64::max);
        let speed = bodies().map(|body| body.material.sound_speed()).fold(0.0, f64::max);
        let dimension = scene.dimension() as i32;
        let power = |x: f64| x.log2().round().exp2();
        let units = Self { length: power(length), time: power(length / speed), stress: power(stress), dimension };
        let [length, time, stress] = [units.length, units.time, units.stress].map(f64::log10);
        let volume = length * f64::from(dimension);
        // Kernel and its second derivative, mass, force, energy, acceleration, squared frequency, what stress is over density
        // squared.
        let density = stress + 2.0 * (time - length);
        let made =
            [volume + 2.0 * length, density + volume, stress + volume, length - 2.0 * time, 2.0 * time, stress - 2.0 * density];
        made.iter().any(|power| power.abs() > ROOM).then_some(units)
    }

    fn length_to(&self, power: i32) -> f64 {
        self.length.powi(power)
    }

    fn rate(&self) -> f64 {
        1.0 / self.time
    }

    /// One unit inside of a quantity whose unit is length^a mass^b time^c. Masses, forces, energies, volumes and areas are of
    /// the scene's own dimension, as if per unit of length across the plane; stresses and densities are not.
    fn unit(&self, [a, b, c]: Unit) -> f64 {
        let extensive = matches!([a, b, c], [3, 0, 0] | [2, 0, 0] | [1, 1, -2] | [2, 1, -2] | [0, 1, 0]);
        let (a, b, c) = (i32::from(a), i32::from(b), i32::from(c));
        // A mass is stress length time^2.
        let lacking = if extensive { 3 - self.dimension } else { 0 };
        self.length_to(a + b - lacking) * self.time.powi(c + 2 * b) * self.stress.powi(b)
    }

    fn body<R: Real>(&self, body: &mut Body<R>) {
        let by = |x: &mut R, unit: f64| *x = *x * R::of(1.0 / unit);
        by(&mut body.density, self.unit([-3, 1, 0]));
        for stress in [&mut body.bulk_modulus, &mut body.shear_modulus, &mut body.youngs_modulus, &mut body.yield_stress] {
            by(stress, self.stress);
        }
        by(&mut body.sound_speed, self.length * self.rate());
        by(&mut body.smoothing_length, self.length);
        by(&mut body.frequency, self.rate());
        let held = |law: &&Law| match law.role() {
            Role::Whole => body.whole == law.number(),
            Role::Pressure => body.pressure == law.number(),
            Role::Strength => body.strength == law.number(),
            Role::Heat => body.heat == law.number(),
        };
        for law in Law::ALL.iter().filter(held) {
            let declared = law.declaration();
            for (k, number) in declared.numbers.iter().enumerate() {
                // Temperatures keep their unit.
                let [a, b, c, _] = number.dimensions;
                by(&mut body.numbers[declared.role.first() + k], self.unit([a, b, c]));
            }
        }
    }

    /// The same state in these units.
    pub fn scale<S: Space>(&self, state: &mut State<S>) {
        let by = |x: &mut S::Real, unit: f64| *x = *x * S::Real::of(1.0 / unit);
        let (length, time, acceleration) = (self.length, self.time, self.unit([1, 0, -2]));
        let p = &mut state.params;
        for plane in &mut p.planes {
            by(&mut plane[3], length);
        }
        for x in [
            &mut p.origin_x,
            &mut p.origin_y,
            &mut p.origin_z,
            &mut p.cell_x,
            &mut p.cell_y,
            &mut p.cell_z,
            &mut p.period_x,
            &mut p.period_y,
            &mut p.period_z,
            &mut p.reach,
            &mut p.contact_reach,
            &mut p.facet_reach,
            &mut p.contact_apart,
            &mut p.slack,
        ] {
            by(x, length);
        }
        for x in [&mut p.body_force_x, &mut p.body_force_y, &mut p.body_force_z] {
            by(x, acceleration);
        }
        by(&mut p.contact_rate, self.rate() * self.rate());
        by(&mut p.artificial_weight, self.length_to(-self.dimension));
        for x in [&mut p.fixed_step, &mut p.rest_step, &mut p.interval] {
            by(x, time);
        }
        by(&mut p.load_rate, self.rate());
        state.bodies.iter_mut().for_each(|body| self.body(body));
        for pair in &mut state.contact_pairs {
            let strength = match pair.law {
                ZONES => self.unit([1, 1, -2]),
                COLOUR_FIELD => self.stress,
                _ => self.unit([2, 1, -2]),
            };
            by(&mut pair.strength, strength);
            by(&mut pair.range, length);
        }
        for pair in state.facet_pairs.iter_mut().chain(&mut state.obstacle_pairs) {
            by(&mut pair.stiffness, self.stress / length);
            by(&mut pair.range, length);
        }
        for obstacle in &mut state.obstacles {
            for x in [&mut obstacle.point_x, &mut obstacle.point_y, &mut obstacle.point_z, &mut obstacle.radius] {
                by(x, length);
            }
        }
        for mover in &mut state.movers {
            by(&mut mover.inverse_mass, 1.0 / self.unit([0, 1, 0]));
        }
        for held in &mut state.constraints {
            for (k, x) in [&mut held.x, &mut held.y, &mut held.z].into_iter().enumerate() {
                by(x, if held.prescribed >> k & 1 == 1 { length * self.rate() } else { acceleration });
            }
        }
        state.course.iter_mut().for_each(|point| by(&mut point[0], time));
        for field in state.columns.present() {
            if field.kind() != Type::Integer && field.unit() != [0; 3] {
                let unit = self.unit(field.unit());
                bytemuck::cast_slice_mut::<u8, S::Real>(state.columns.bytes_mut(field)).iter_mut().for_each(|x| by(x, unit));
            }
        }
    }
}

/// A machine that steps in units of its own.
pub struct Scaled {
    inner: Box<dyn Backend>,
    units: Units,
}

impl Scaled {
    /// The inner machine has tables that [`Units::scale`] has scaled.
    pub fn new(inner: Box<dyn Backend>, units: Units) -> Self {
        Self { inner, units }
    }
}

impl Backend for Scaled {
    fn describe(&self) -> String {
        self.inner.describe()
    }
    fn bytes(&self) -> u64 {
        self.inner.bytes()
    }
    fn begin_segment(&mut self, start: f64, duration: f64, steps: u32, first: bool) -> Result<(), String> {
        self.inner.begin_segment(start / self.units.time, duration / self.units.time, steps, first)
    }
    fn advance(&mut self) -> Result<Clock<f64>, String> {
        let (mut clock, time) = (self.inner.advance()?, self.units.time);
        for x in [
            &mut clock.start,
            &mut clock.elapsed,
            &mut clock.elapsed_carry,
            &mut clock.step,
            &mut clock.duration,
            &mut clock.held,
        ] {
            *x *= time;
        }
        Ok(clock)
    }
    fn fetch(&mut self, fields: &[Field]) -> Result<Fetched, String> {
        let mut fetched = self.inner.fetch(fields)?;
        for (field, column) in &mut fetched {
            let unit = self.units.unit(field.unit());
            if field.kind() != Type::Integer && unit != 1.0 {
                column.iter_mut().for_each(|x| *x *= unit);
            }
        }
        Ok(fetched)
    }
    fn save(&mut self) -> Result<Vec<Saved>, String> {
        self.inner.save()
    }
    fn load(&mut self, groups: &[Saved]) -> Result<(), String> {
        self.inner.load(groups)
    }
    fn clocks(&mut self) -> Result<Vec<Clock<f64>>, String> {
        self.inner.clocks()
    }
    fn set_clocks(&mut self, clocks: &[Clock<f64>]) -> Result<(), String> {
        self.inner.set_clocks(clocks)
    }
    fn time_passes(&mut self, calls: &[Call], repeats: u32) -> Result<Vec<(String, f64)>, String> {
        self.inner.time_passes(calls, repeats)
    }
}
