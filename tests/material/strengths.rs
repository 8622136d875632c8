//! Every strength that yields, as it declares itself: what it bears beside published and independent tables, and the
//! return that brings a particle there in both formulations.

use crate::common::Random;
use crate::common::deformation::*;
use crate::common::scene_folder;
use lithosph::material::yielding::{Before, mises, yielded};
use lithosph::material::{self, Declaration, Law, Point, Role, strain};
use lithosph::rows::Body;
use lithosph::scene::Scene;
use lithosph::tensor::{Plane, Solid, Space};

fn metals() -> impl Iterator<Item = Law> {
    Law::of_role(Role::Strength).filter(|law| law.yields())
}

fn samples(declared: &Declaration) -> Vec<f64> {
    declared.numbers.iter().map(|number| number.sample).collect()
}

/// A body of modulus, density and temperature 1 with the numbers that its laws declare for tests.
fn sampled(strength: Law) -> Body<f64> {
    let body = Body { density: 1.0, bulk_modulus: 1.0 / 1.2, shear_modulus: 1.0 / 2.6, youngs_modulus: 1.0, ..Body::default() };
    let body = [Law::HartmannNeff, strength, Law::Adiabatic]
        .into_iter()
        .fold(body, |body, law| body.with(law, &samples(law.declaration())));
    let rest = material::flow(&body, &Point { strain: 0.0, rate: 1.0, temperature: 1.0 });
    Body { yield_stress: rest.stress, ..body }
}

#[test]
fn slopes_are_the_derivatives_of_the_stress() {
    for law in metals() {
        let (body, mut random) = (sampled(law), Random(11));
        for _ in 0..200 {
            let at = Point { strain: 0.5 * random.unit() + 1e-3, rate: 1e3f64.powf(random.signed()), temperature: 1.0 };
            let (flow, e) = (material::flow(&body, &at), 1e-6);
            let between = |a: Point<f64>, b: Point<f64>| material::flow(&body, &a).stress - material::flow(&body, &b).stress;
            let (dk, dr) = (e * at.strain, e * at.rate);
            let by_strain = between(Point { strain: at.strain + dk, ..at }, Point { strain: at.strain - dk, ..at }) / (2.0 * dk);
            let by_rate = between(Point { rate: at.rate + dr, ..at }, Point { rate: at.rate - dr, ..at }) / (2.0 * dr);
            let scale = flow.stress * 1e-7;
            assert!((flow.by_strain - by_strain).abs() * at.strain < scale, "{law:?} {at:?}: {} {by_strain}", flow.by_strain);
            assert!((flow.by_rate - by_rate).abs() * at.rate < scale, "{law:?} {at:?}: {} {by_rate}", flow.by_rate);
        }
    }
}

/// The deviator comes to rest where the strength says, at the strain, the rate and the temperature that it has come to.
#[test]
fn the_return_ends_on_the_yield_surface() {
    type S = Solid<f64>;
    for law in metals() {
        let (body, mut random, mut worst) = (sampled(law), Random(12), 0.0f64);
        for _ in 0..2000 {
            let mut trial = <S as Space>::Sym::default();
            let size = 10f64.powf(-3.0 + 3.0 * random.unit());
            (3..6).for_each(|k| trial[k] = size * random.signed());
            let strain = if random.coin() { 0.0 } else { random.unit() };
            let before = Before { strain, temperature: 1.0 + random.unit(), volume: 1.0 + 0.1 * random.signed() };
            let step = 10f64.powf(-4.0 + 5.0 * random.unit());
            let after = yielded::<S>(&body, trial, before, step);
            let temperature = before.temperature + material::rise(&body, after.work);
            let at = Point { strain: strain + after.growth, rate: after.growth / step, temperature };
            let (q, bears) = (mises::<S>(after.deviator), material::flow(&body, &at).stress);
            if after.growth > 0.0 {
                worst = worst.max((q / bears - 1.0).abs());
            } else {
                assert!(q <= material::flow(&body, &Point { rate: 0.0, ..at }).stress, "{law:?}: {q} {before:?}");
            }
        }
        println!("{law:?}: the Mises stress is off what the strength bears by {worst:.1e}");
        assert!(worst < 2e-13, "{law:?}: {worst:e}");
    }
}

#[test]
fn the_return_at_finite_strain_ends_there_too() {
    type S = Plane<f64>;
    for law in metals() {
        let (body, mut random, mut worst, mut flowed) = (sampled(law), Random(13), 0.0f64, 0);
        for _ in 0..500 {
            let (h, old) = (gradient::<S>(&mut random, 0.1), memory::<S>(&mut random, 0.05));
            let before = material::Memory { temperature: 1.5, ..remembering::<S>(old, 0.3 * random.unit()) };
            let step = 10f64.powf(-2.0 + 3.0 * random.unit());
            let after = material::relax::<S>(&body, h, before, step);
            let growth = after.plastic - before.plastic;
            if growth == 0.0 {
                continue;
            }
            flowed += 1;
            let kirchhoff = material::cauchy::<S>(&body, h, after.strain) * (1.0 + strain::volume_change::<S>(h));
            // In the plane the component across follows from the mean, which is that of the pressure.
            let mean = material::kirchhoff(&body, strain::volume_change::<S>(h));
            let q = mises::<S>(kirchhoff - S::diagonal(mean));
            let at = Point { strain: after.plastic, rate: growth / step, temperature: after.temperature };
            // The growth is known to the last digit of the sum alone, and no strength changes faster than its rate.
            let known = f64::EPSILON * after.plastic / growth;
            worst = worst.max((q / material::flow(&body, &at).stress - 1.0).abs() / (1.0 + known / 1e-13));
        }
        println!("{law:?} at finite strain: {flowed} flowed, the Mises stress is off by {worst:.1e}");
        assert!(flowed > 100 && worst < 1e-12, "{law:?}: {flowed} {worst:e}");
    }
}

/// A table `scenes/reference/flow_stress_*.csv` names a scene and its material, and holds what the material bears at
/// plastic strains reached at a rate, at a temperature that stays or that the work raises.
#[test]
fn strengths_bear_what_independent_tables_say() {
    let folder = scene_folder().join("reference");
    let mut tables = 0;
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !name.starts_with("flow_stress_") {
            continue;
        }
        tables += 1;
        let text = std::fs::read_to_string(&path).unwrap();
        let stem = text.lines().find_map(|line| line.strip_prefix("# scene = ")).expect("the table names its scene");
        let scene = Scene::open(&scene_folder().join(format!("{stem}.toml")), None, &[]).unwrap();
        let body = scene.bodies[0].numbers::<f64>();
        let mut worst = [0.0f64; 2];
        for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |k: usize| cells[k].parse::<f64>().unwrap();
            let (rate, start, end) = (number(1), number(2), number(3));
            let warm = if cells[0] == "adiabatic" { warmed(&body, rate, start, end) } else { start };
            let stress = material::flow(&body, &Point { strain: end, rate, temperature: warm }).stress;
            worst[0] = worst[0].max((stress / number(4) - 1.0).abs());
            worst[1] = worst[1].max((warm / number(5) - 1.0).abs());
        }
        println!("{name}: stress off by {:.1e}, temperature by {:.1e}", worst[0], worst[1]);
        assert!(worst.iter().all(|error| *error < 1e-6), "{name}: {worst:?}");
    }
    let reads = |law: &Law| !law.declaration().reads.is_empty();
    assert_eq!(tables, metals().filter(reads).count(), "each strength that depends on rate or temperature has a table");
}

/// The temperature after plastic work at a rate up to a strain: classical Runge-Kutta in the square root of the strain,
/// in which a parabola begins smoothly.
fn warmed(body: &Body<f64>, rate: f64, start: f64, end: f64) -> f64 {
    let steps = 400;
    let step = end.sqrt() / f64::from(steps);
    let slope = |root: f64, temperature: f64| {
        let bears = material::flow(body, &Point { strain: root * root, rate, temperature }).stress;
        material::rise(body, bears * 2.0 * root)
    };
    let mut temperature = start;
    for k in 0..steps {
        let root = f64::from(k) * step;
        let a = slope(root, temperature);
        let b = slope(root + 0.5 * step, temperature + 0.5 * step * a);
        let c = slope(root + 0.5 * step, temperature + 0.5 * step * b);
        let d = slope(root + step, temperature + step * c);
        temperature += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    temperature
}
