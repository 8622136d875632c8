//! Two discs that collide off centre, and what the collision leaves of momenta and energy.

use crate::common::parse;
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::fields::Field;
use lithosph::observable::Moment;
use lithosph::scene::Scene;
use lithosph::tensor::{Plane, Space};

pub const LAGRANGIAN: &str = "kind = 'total_lagrangian'";

/// Every law that has an energy, of a Total Lagrangian scene: its line of the contact, and the gap in which it ends.
pub const WITH_ENERGY: [(&str, f64); 5] = [
    ("potential = { law = 'barrier', stiffness = 0.3, range = 1.0 }", 1.0),
    ("potential = { law = 'quadratic', stiffness = 0.3, range = 2.0 }", 2.0),
    ("potential = { law = 'power', stiffness = 1.0, range = 2.0 }", 2.0),
    ("potential = { law = 'repulsive', stiffness = 0.3, range = 2.6 }", 2.6),
    ("colour_field = { stiffness = 2.0, threshold = 0.1, range = 4.0 }", 3.0),
];

/// Two discs of radius 6 that meet at relative speed `speed`, off centre by `offset`, `gap` apart when they start.
pub fn discs(contact: &str, formulation: &str, place: [f64; 2], speed: f64) -> Scene {
    discs_of(6.0, contact, formulation, place, speed)
}

pub fn discs_of(radius: f64, contact: &str, formulation: &str, [gap, offset]: [f64; 2], speed: f64) -> Scene {
    let law = if formulation.contains("total_lagrangian") { "law = 'neo_hookean'" } else { "" };
    let center = radius + 0.5 * gap;
    let body = |name: &str, x: f64, y: f64, v: f64| {
        format!(
            "[[body]]\nname = '{name}'\nshape = {{ disc = {{ center = [{x}, {y}], radius = {radius} }} }}\nanchor = [{x}, {y}]\n\
             material = 'rubber'\nvelocity = [{v}, 0.0]\n"
        )
    };
    let (half, height) = (0.5 * speed, 0.5 * offset);
    parse(&format!(
        "title = 'discs'\ndimension = 2\nspacing = 1.0\nduration = 1.0\n{}{}\
         [material.rubber]\n{law}\ndensity = 1.0\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n\
         [[contact]]\nbetween = ['a', 'b']\n{contact}\n[formulation]\nsmoothing_length = 1.5\n{formulation}\n",
        body("a", -center, -height, half),
        body("b", center, height, -half),
    ))
}

/// After the first forces, at the start.
pub fn begun<S: Space>(scene: &Scene) -> Cpu<S> {
    let mut cpu = Cpu::new(scene.state::<S>(false));
    cpu.begin_segment(0.0, 0.0, u32::MAX, true).unwrap();
    cpu.members[0].clock.running = 1;
    cpu
}

/// Momentum over sum m|v|, angular momentum over sum m|x||v|, and energy over its first value, each less that of the
/// start; and the velocity at which the discs part over that at which they met.
pub struct Change {
    pub momentum: f64,
    pub spin: f64,
    pub energy: f64,
    pub restitution: f64,
    /// Most energy that the contact held, over that of the start.
    pub contact: f64,
}

struct Sums {
    momentum: [f64; 2],
    spin: f64,
    scales: [f64; 2],
    energy: f64,
    contact: f64,
    /// Mean velocity along x of the first body less that of the second.
    closing: f64,
}

fn sums(scene: &Scene, backend: &mut dyn Backend) -> Sums {
    let present = lithosph::step::fields(&scene.method);
    let mut wanted = vec![Field::Number, Field::Displacement, Field::Velocity];
    let stored = [
        Field::DisplacementGradient,
        Field::VolumetricStrain,
        Field::DeviatoricStress,
        Field::HourglassEnergy,
        Field::ContactEnergy,
    ];
    wanted.extend(stored.into_iter().filter(|field| present.contains(field)));
    let columns = backend.fetch(&wanted).unwrap();
    let moment = Moment::new(scene, 0.0, 0, &columns);
    let mut sums = Sums { momentum: [0.0; 2], spin: 0.0, scales: [0.0; 2], energy: 0.0, contact: 0.0, closing: 0.0 };
    let mut mass = [0.0; 2];
    for i in 0..scene.particles.len() {
        let (m, x, v) = (scene.mass(i), moment.position(i), moment.vector(Field::Velocity, i));
        let speed = v[0].hypot(v[1]);
        sums.momentum[0] += m * v[0];
        sums.momentum[1] += m * v[1];
        sums.spin += m * (x[0] * v[1] - x[1] * v[0]);
        sums.scales[0] += m * speed;
        sums.scales[1] += m * x[0].hypot(x[1]) * speed;
        sums.energy += 0.5 * m * speed * speed + moment.elastic_energy(i) + moment.scalar(Field::HourglassEnergy, i);
        sums.contact += moment.scalar(Field::ContactEnergy, i);
        let body = scene.particles[i].body as usize;
        mass[body] += m;
        sums.closing += m * v[0] * if body == 0 { 1.0 } else { -1.0 };
    }
    sums.closing /= mass[0];
    sums.energy += sums.contact;
    sums
}

/// Runs a collision for a time in 20 parts.
pub fn collide(scene: &Scene, duration: f64) -> Change {
    let mut cpu = Cpu::new(scene.state::<Plane<f64>>(false));
    cpu.begin_segment(0.0, 0.0, u32::MAX, true).unwrap();
    let start = sums(scene, &mut cpu);
    let (mut end, mut contact) = (sums(scene, &mut cpu), 0.0f64);
    for _ in 0..20 {
        cpu.begin_segment(0.0, duration / 20.0, u32::MAX, false).unwrap();
        while cpu.advance().unwrap().running == 1 {}
        assert_eq!(cpu.members[0].clock.fault, 0);
        end = sums(scene, &mut cpu);
        contact = contact.max(end.contact);
    }
    let moved = (end.momentum[0] - start.momentum[0]).hypot(end.momentum[1] - start.momentum[1]);
    Change {
        momentum: moved / start.scales[0],
        spin: (end.spin - start.spin) / start.scales[1],
        energy: end.energy / start.energy - 1.0,
        restitution: -end.closing / start.closing,
        contact: contact / start.energy,
    }
}
