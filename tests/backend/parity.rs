//! Every pass on the GPU against its twins in f64 and f32; then whole runs.
//!
//! Before each pass the GPU and both twins get the same numbers, all of them f32. What they are compared by is
//! [`compare`]'s rule; what is compared is every binding that the shader can write, as reflection finds it.

pub mod cases;
mod compare;
mod tables;
mod trial;

use crate::common::{adapter, in_order, largest, parse, steps};
use cases::{Case, cases};
use compare::Row;
use lithosph::backend::Backend;
use lithosph::backend::cpu::Cpu;
use lithosph::backend::gpu::{Gpu, Options};
use lithosph::fields::{Field, SCAN_BLOCK};
use lithosph::method::{FLAGS, Method};
use lithosph::pass::{Call, Pass, Stage};
use lithosph::rows::Fault;
use lithosph::scene::Scene;
use lithosph::state::State;
use lithosph::step;
use lithosph::tensor::{Line, Plane, Solid, Space};
use std::collections::{BTreeMap, BTreeSet};
use tables::{convert, download, random_state, upload};
use trial::{Trial, calls};

/// One with which rounding decides nothing, see [`compare::assert_rounding_decides_nothing`].
const SEED: u64 = 2010;
/// Fraction of the usual step that makes increments small against what they are added to, so that it shows
/// whether sums are compensated.
const SHORT: f32 = 1.0 / 512.0;

fn try_case<W: Space<Real = f64>, N: Space<Real = f32>>(case: &Case, adapter: &wgpu::Adapter) -> Vec<Row> {
    let state = random_state::<N>(case, SEED, 1.0);
    let mut trial = Trial::<W, N>::new(adapter, state, None);
    let calls = calls(&trial.truth.method.clone());
    for &call in &calls {
        trial.run(call);
        trial.assert_split_alike(call);
    }
    if calls.iter().any(|call| call.pass == Pass::Stress) {
        trial.run_long_stress();
    }
    if trial.truth.method.between {
        trial.run_meetings();
    } else if trial.truth.method.quasi_static.is_some() {
        trial.run_descent_ends();
    } else {
        trial.run_ends();
    }
    trial.assert_idle();
    if case.compensated {
        trial.truth = convert(&random_state::<N>(case, SEED + 1, SHORT));
        calls.into_iter().for_each(|call| trial.run(call));
    }
    trial.rows
}

/// Worst row of each pass.
fn report(rows: &[Row]) {
    let mut table: BTreeMap<Pass, &Row> = BTreeMap::new();
    for row in rows {
        let worst = table.entry(row.pass).or_insert(row);
        if row.ratio() > worst.ratio() {
            *worst = row;
        }
    }
    println!("{:<18} {:>6} {:>9} {:>9}  binding", "pass", "ratio", "gpu", "twin");
    for (pass, row) in table {
        println!("{:<18} {:>6.2} {:>9.1e} {:>9.1e}  {}", pass.name(), row.ratio(), row.gpu, row.twin, row.binding);
    }
}

fn passes_agree<W: Space<Real = f64>, N: Space<Real = f32>>() {
    let Some(adapter) = adapter() else { return };
    let (mut all, mut bad) = (Vec::new(), Vec::new());
    for case in cases(W::DIMENSION) {
        println!("{}", case.name);
        let rows = try_case::<W, N>(&case, &adapter);
        bad.extend(rows.iter().filter(|row| !row.good).map(|row| format!("{}: {row:?}", case.name)));
        all.extend(rows);
    }
    report(&all);
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

#[test]
fn passes_agree_in_one_dimension() {
    passes_agree::<Line<f64>, Line<f32>>();
}

#[test]
fn passes_agree_in_two_dimensions() {
    passes_agree::<Plane<f64>, Plane<f32>>();
}

#[test]
fn passes_agree_in_three_dimensions() {
    passes_agree::<Solid<f64>, Solid<f32>>();
}

#[test]
fn the_cases_switch_on_everything() {
    let (mut flags, mut passes, mut kernels, mut blocks) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new(), 0);
    for case in (1..=3).flat_map(cases) {
        let scene = case.scene();
        let method = Method { compensated: case.compensated, ..scene.method.clone() };
        flags.extend(method.flags());
        passes.extend(step::passes(&method));
        kernels.insert(method.smoothing.word());
        blocks = blocks.max(scene.state::<Line<f32>>(false).params.cell_total as usize / SCAN_BLOCK);
        assert!(scene.particles.len() >= 1000);
    }
    assert_eq!(flags, FLAGS.iter().map(|(word, _)| *word).collect());
    assert_eq!(passes, Pass::ALL.iter().copied().collect());
    assert_eq!(kernels.len(), lithosph::smoothing::Smoothing::ALL.len());
    assert!(blocks > 0, "the prefix sum of no case takes more than one block");
}

/// A change of one pass's text.
struct Sabotage {
    pass: Pass,
    from: &'static str,
    to: &'static str,
}

/// Bindings that fail after it, at a fraction of the usual step.
fn failures(sabotage: Sabotage, step: f32) -> Option<BTreeSet<String>> {
    let adapter = adapter()?;
    let Sabotage { pass, from, to } = sabotage;
    let patch = move |at: Pass, text: String| {
        assert!(at != pass || text.contains(from), "there is nothing to sabotage");
        if at == pass { text.replace(from, to) } else { text }
    };
    let state = random_state::<Plane<f32>>(&cases(2)[0], SEED, step);
    let mut trial = Trial::<Plane<f64>, Plane<f32>>::new(&adapter, state, Some(Box::new(patch)));
    for call in calls(&trial.truth.method.clone()) {
        trial.run(call);
    }
    Some(trial.rows.into_iter().filter(|row| !row.good).map(|row| format!("{} {}", row.pass.name(), row.binding)).collect())
}

#[test]
fn a_factor_half_a_percent_off_fails_where_it_is_used() {
    let sabotage = Sabotage { pass: Pass::Force, from: "pair.x * pair.gradient", to: "pair.x * (1.005 * pair.gradient)" };
    let Some(bad) = failures(sabotage, 1.0) else { return };
    let wanted = ["force acceleration", "force dissipated_power", "force internal_power"].map(String::from);
    assert_eq!(bad, wanted.into_iter().collect());
}

#[test]
fn a_forgotten_store_fails() {
    let sabotage = Sabotage { pass: Pass::Force, from: "internal_power[a] = sums.internal_power;", to: "" };
    let Some(bad) = failures(sabotage, 1.0) else { return };
    assert_eq!(bad, BTreeSet::from(["force internal_power".to_string()]));
}

#[test]
fn lost_compensation_fails() {
    let (from, to) = ("displacement_carry[a] = result.carry", "displacement_carry[a] = Vec()");
    let Some(bad) = failures(Sabotage { pass: Pass::Drift, from, to }, SHORT) else { return };
    assert_eq!(bad, BTreeSet::from(["drift displacement - displacement_carry".to_string()]));
}

/// Fault after a step from a state that was tampered with, on the twin and on the GPU.
fn faults(adapter: &wgpu::Adapter, case: &Case, tamper: impl Fn(&mut State<Plane<f32>>)) -> [Option<Fault>; 2] {
    let mut twin = random_state::<Plane<f32>>(case, SEED, 1.0);
    tamper(&mut twin);
    let mut gpu = Gpu::new(adapter, &twin).unwrap();
    upload(&mut gpu, &twin);
    let mut seen = twin.clone();
    let mut calls = step::begin_segment(&twin.method);
    calls.push(Call { pass: Pass::BoundTimeStep, stage: Stage::default() });
    gpu.run_calls(&calls).unwrap();
    download(&gpu, &mut seen, &["clock"]);
    calls.iter().for_each(|call| call.pass.run(&mut twin, call.stage));
    assert_eq!((seen.clock.running, twin.clock.running), (0, 0));
    [twin, seen].map(|state| Fault::from_number(state.clock.fault))
}

#[test]
fn the_gpu_and_its_twin_stop_with_the_same_fault() {
    let Some(adapter) = adapter() else { return };
    let case = Case { formulation: "", ..cases(2)[0] };
    let tight = Case { formulation: "list_capacity = 8", ..case };
    assert_eq!(faults(&adapter, &tight, |_| ()), [Some(Fault::ListFull); 2]);
    for bad in [f32::NAN, f32::INFINITY] {
        assert_eq!(faults(&adapter, &case, |state| state.columns.velocity[999].0[1] = bad), [Some(Fault::NotFinite); 2]);
    }
    assert_eq!(faults(&adapter, &case, |state| state.columns.volumetric_strain[300] = -1.5), [Some(Fault::Inverted); 2]);
}

/// Two rings that meet after a few steps.
fn rings(formulation: &str) -> Scene {
    parse(&format!(
        r#"
title = "rings"
dimension = 2
spacing = 1.0
duration = 1.0
[[body]]
name = "left"
shape = {{ ring = {{ center = [-15.2, 0], outer = 15, inner = 10 }} }}
anchor = [-15.2, 0]
material = "rubber"
velocity = [0.08, 0]
[[body]]
name = "right"
shape = {{ ring = {{ center = [15.2, 0], outer = 15, inner = 10 }} }}
anchor = [15.2, 0]
material = "rubber"
velocity = [-0.08, 0]
[material.rubber]
density = 1.0
youngs_modulus = 1.0
poisson_ratio = 0.3
[formulation]
smoothing_length = 1.5
viscosity = {{ alpha = 1.0 }}
{formulation}
"#
    ))
}

const RINGS: &str = "xsph = 0.5\nartificial_stress = { epsilon = 0.3, exponent = 6 }\ninternal_energy = true";

#[test]
fn a_run_on_the_gpu_repeats_bit_for_bit() {
    let Some(adapter) = adapter() else { return };
    let scene = rings(RINGS);
    let run = |longest_part| {
        let options = Options { longest_part, patch: None };
        let mut gpu = Gpu::with_options(&adapter, &scene.state::<Plane<f32>>(true), options).unwrap();
        assert_eq!(steps(&mut gpu, 200).steps_done, 200);
        let saved = gpu.save().unwrap();
        // The segment is over: further steps change nothing.
        gpu.advance().unwrap();
        assert!(saved == gpu.save().unwrap());
        saved
    };
    let first = run(None);
    assert!(first == run(None));
    assert!(first == run(Some(300)), "a list in parts changes the run");
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = rings(RINGS);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut cpu = Cpu::new(scene.state::<Plane<f64>>(false));
            steps(&mut cpu, 200);
            cpu.save().unwrap()
        })
    };
    let alone = run(1);
    assert!(alone == run(2) && alone == run(2));
}

#[test]
fn the_gpu_follows_f64_through_a_collision() {
    let Some(adapter) = adapter() else { return };
    let scene = rings(RINGS);
    let mut cpu = Cpu::new(scene.state::<Plane<f64>>(false));
    let mut gpu = Gpu::new(&adapter, &scene.state::<Plane<f32>>(true)).unwrap();
    let clocks = (steps(&mut cpu, 100), steps(&mut gpu, 100));
    assert_eq!((clocks.0.steps_done, clocks.0.lists_built), (clocks.1.steps_done, clocks.1.lists_built));
    let (wanted, seen) = (in_order(&mut cpu, Field::Displacement), in_order(&mut gpu, Field::Displacement));
    let moved = largest(wanted.iter().copied());
    let error = largest(wanted.iter().zip(&seen).map(|(a, b)| a - b));
    println!("after 100 steps: displacement {moved:.3}, error {:.1e} of it", error / moved);
    let strain = largest(in_order(&mut cpu, Field::VolumetricStrain));
    assert!(strain > 1e-3, "nothing has collided: {strain}");
    assert!(error < 1e-5 * moved, "{error} of {moved}");
}
