//! The Maxwell body: it relaxes as it must, forgets no volume, and turns into heat what it loses.

use crate::common::Random;
use crate::common::deformation::*;
use lithosph::backend::Choice;
use lithosph::material::{Law, cauchy, dissipated, first_piola, maxwell, relax, stored_energy, strain};
use lithosph::run::{Options, run};
use lithosph::tensor::{Line, Plane, Solid, Space, Tuple};

const SAMPLES: usize = 100;

fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// Memory after a time at a fixed deformation, from none, and the heat made.
fn held<S: Space<Real = f64>>(h: S::Mat, time: f64, steps: u32) -> (S::Sym, f64) {
    let body = body::<f64>(Law::Maxwell);
    let (mut memory, mut heat) = (S::Sym::default(), 0.0);
    for _ in 0..steps {
        let next = relax::<S>(&body, h, remembering(memory, 0.0), time / f64::from(steps)).strain;
        heat += dissipated::<S>(&body, (h, memory), (h, next));
        memory = next;
    }
    (memory, heat)
}

#[test]
fn a_small_stress_decays_exponentially() {
    type S = Plane<f64>;
    let h = Tuple([0.0, 0.0, 2e-6, 0.0]);
    let body = body::<f64>(Law::Maxwell);
    let time = 1.3 / (body.shear_modulus / 1.0);
    let wanted = body.shear_modulus * 2e-6 * (-1.3f64).exp();
    let error = |steps| (cauchy::<S>(&body, h, held::<S>(h, time, steps).0)[2] / wanted - 1.0).abs();
    let errors = [20, 40, 80, 160].map(error);
    println!("errors of the relaxed stress {errors:?}, orders {:.2?}", orders(&errors));
    assert!(errors[3] < 1e-2 && orders(&errors).iter().all(|order| (order - 1.0).abs() < 0.05), "{errors:?}");
}

#[test]
fn without_limit_of_time_only_pressure_is_left() {
    let mut random = Random(7);
    for _ in 0..SAMPLES {
        let h = gradient::<Solid<f64>>(&mut random, 0.25);
        let stress = cauchy::<Solid<f64>>(&body(Law::Maxwell), h, held::<Solid<f64>>(h, 80.0, 400).0);
        let [xx, yy, zz, xy, yz, xz] = stress.0;
        assert!([xx - yy, yy - zz, xy, yz, xz].iter().all(|s| s.abs() < 1e-13), "{stress:?}");
    }
}

#[test]
fn viscous_strain_keeps_the_volume() {
    let mut random = Random(8);
    let (mut wide, mut narrow) = (Tuple::default(), Tuple::default());
    for _ in 0..10_000 {
        let h = gradient::<Solid<f64>>(&mut random, 0.3);
        wide = relax::<Solid<f64>>(&body(Law::Maxwell), h, remembering(wide, 0.0), 0.05).strain;
        let h = embedded::<Solid<f64>, Solid<f32>>(h);
        narrow = relax::<Solid<f32>>(&body(Law::Maxwell), h, remembering(narrow, 0.0), 0.05).strain;
    }
    let change = strain::volume_change::<Solid<f64>>(Solid::<f64>::mat_of_sym(wide));
    let single = strain::volume_change::<Solid<f32>>(Solid::<f32>::mat_of_sym(narrow));
    println!("det C_i - 1 after 10,000 steps: f64 {change:.1e}, f32 {single:.1e}");
    assert!(change.abs() < 1e-15 && single.abs() < 4e-7);
}

fn endless_viscosity_is_neo_hookean<S: Space<Real = f64>>() {
    let mut random = Random(9);
    let elastic = body::<f64>(Law::NeoHookean);
    let viscous = body::<f64>(Law::Maxwell).with(Law::Maxwell, &[f64::INFINITY]);
    for _ in 0..SAMPLES {
        let (h, none) = (gradient::<S>(&mut random, 0.3), S::Sym::default());
        assert!(relax::<S>(&viscous, h, remembering(none, 0.0), 0.1).strain == none);
        let (a, b) = (first_piola::<S>(&viscous, h, none), first_piola::<S>(&elastic, h, none));
        assert!(apart::<S>(a, b) < 1e-14 * (1.0 + size::<S>(b)));
        let energies = [&viscous, &elastic].map(|body| stored_energy::<S>(body, h, none));
        assert!((energies[0] - energies[1]).abs() < 1e-14);
    }
}

#[test]
fn endless_viscosity_is_neo_hookean_in_every_dimension() {
    endless_viscosity_is_neo_hookean::<Line<f64>>();
    endless_viscosity_is_neo_hookean::<Plane<f64>>();
    endless_viscosity_is_neo_hookean::<Solid<f64>>();
}

/// At a fixed deformation: errors of the heat of a time against the energy lost, and of the rate.
fn heat_is_energy_lost<S: Space<Real = f64>>() {
    let mut random = Random(10);
    let body = body::<f64>(Law::Maxwell);
    let h = gradient::<S>(&mut random, 0.3);
    let start = stored_energy::<S>(&body, h, S::Sym::default());
    let errors = [10, 20, 40, 80].map(|steps| {
        let (memory, heat) = held::<S>(h, 1.0, steps);
        (start - stored_energy::<S>(&body, h, memory) - heat).abs() / heat
    });
    println!("{} dimensions: heat off the energy lost {errors:?}, orders {:.2?}", S::DIMENSION, orders(&errors));
    assert!(errors[3] < 1e-4 && orders(&errors).iter().all(|order| *order > 1.8), "{errors:?}");

    let memory = held::<S>(h, 0.2, 10).0;
    let rate = maxwell::dissipation::<S>(&body, h, memory);
    let step = 1e-6;
    let next = relax::<S>(&body, h, remembering(memory, 0.0), step).strain;
    let lost = (stored_energy::<S>(&body, h, memory) - stored_energy::<S>(&body, h, next)) / step;
    let heat = dissipated::<S>(&body, (h, memory), (h, next)) / step;
    assert!((lost / rate - 1.0).abs() < 1e-5 && (heat / rate - 1.0).abs() < 1e-5, "{rate} {lost} {heat}");
}

#[test]
fn heat_is_energy_lost_in_every_dimension() {
    heat_is_energy_lost::<Line<f64>>();
    heat_is_energy_lost::<Plane<f64>>();
    heat_is_energy_lost::<Solid<f64>>();
}

/// Kinetic, elastic and dissipated energy of the plate of Shutov & Klyuchantsev 2019, first and last, and the
/// heat. Without the hourglass energy, which nobody counts.
fn plate(steps: u32) -> ([f64; 2], f64) {
    let text = format!(
        "title = 'plate'
        dimension = 2
        units = 'dimensionless'
        spacing = 0.1
        duration = 0.6
        [[body]]
        name = 'plate'
        shape = {{ block = {{ min = [-0.5, -0.5], max = [0.5, 0.5] }} }}
        anchor = [0, 0]
        material = 'fluid'
        motion = {{ gradient = [[0, 0.8], [0, 0]] }}
        [material.fluid]
        law = 'maxwell'
        density = 3.0
        bulk_modulus = 5.833
        shear_modulus = 1.25
        viscosity = 0.2
        [formulation]
        kind = 'total_lagrangian'
        dissipated_energy = true
        hourglass = 0
        [time]
        step = {step:.17}
        [output]
        series = 0.6
        frames = 0
        [observe]
        total = {{ kind = 'total_energy' }}
        heat = {{ kind = 'dissipated_energy' }}
        ",
        step = 0.6 / f64::from(steps),
    );
    let options = Options { choice: Choice::Cpu, dry: true, quiet: true, ..Options::default() };
    let finished = run(&crate::common::parse(&text), &options).unwrap_or_else(|stop| panic!("{stop:?}"));
    let column = |name: &str| &finished.table.columns[name];
    let total = column("total");
    ([total[0], *total.last().unwrap()], *column("heat").last().unwrap())
}

#[test]
fn energy_of_a_run_is_constant_to_second_order() {
    let results = [40, 80, 160].map(plate);
    let errors = results.map(|([first, last], _)| (last / first - 1.0).abs());
    let heat = results[2].1 / results[2].0[0];
    println!("heat {heat:.3} of the energy, sum off by {errors:?}, orders {:.2?}", orders(&errors));
    assert!(heat > 0.1 && errors[2] < 1e-4 && orders(&errors).iter().all(|order| *order > 1.8), "{heat} {errors:?}");
}
