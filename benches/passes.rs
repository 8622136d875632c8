//! Time of every pass, particle-updates per core-second, and bytes per second beside a measured copy.
//!
//! `cargo bench --bench passes -- [particles …] [--gpu] [--method elastic|full|lagrangian|lagrangian_listed]`
//! `cargo bench --bench passes -- --scene FILE [--variant NAME] [--time T] [--gpu]`
//!
//! The body is a cube on a cubic lattice with h = 1.22 spacings, about 60 neighbours, kicked by a smooth wave; or the
//! scene in a file, as it is at time T.
//! Machines are shared, so times on the CPU path are processor seconds, and the best of several rounds counts.

use lithosph::backend::cpu::processor_seconds;
use lithosph::backend::device::{Want, choose};
use lithosph::backend::{Backend, Choice, open};
use lithosph::fields::Field;
use lithosph::scene::Scene;
use lithosph::step;
use std::time::Instant;

const ROUNDS: usize = 3;

fn scene(particles: usize, method: &str) -> Scene {
    let side = (particles as f64).cbrt().round();
    let extras = match method {
        "lagrangian" => "kind = \"total_lagrangian\"",
        "lagrangian_listed" => "kind = \"total_lagrangian\"\nbond_table = false",
        "full" => "viscosity = { alpha = 1.0 }\nxsph = 0.5\nartificial_stress = { epsilon = 0.3 }",
        _ => "",
    };
    let law = if method.starts_with("lagrangian") { "st_venant_kirchhoff" } else { "elastic" };
    let text = format!(
        r#"
title = "benchmark cube"
dimension = 3
spacing = 0.01
duration = 1.0
[[body]]
name = "cube"
shape = {{ block = {{ min = [0, 0, 0], max = [{l}, {l}, {l}] }} }}
anchor = [0.005, 0.005, 0.005]
material = "rubber"
motion = {{ wave = {{ amplitude = [0.1, 0, 0], wave_vector = [{k}, 0, 0] }} }}
[material.rubber]
law = "{law}"
density = 1000
youngs_modulus = 1e7
poisson_ratio = 0.3
[formulation]
smoothing_length = 1.22
{extras}
"#,
        l = side * 0.01,
        k = std::f64::consts::PI / (side * 0.01),
    );
    Scene::parse(&text, "cube", None, &[]).expect("the benchmark's scene is sound")
}

/// Bytes a second, read and written, of a copy much larger than the caches, on all cores.
fn copy_bandwidth() -> f64 {
    use rayon::prelude::*;
    let source = vec![1u64; 1 << 25];
    let mut target = vec![0u64; 1 << 25];
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let begin = Instant::now();
        target.par_chunks_mut(1 << 16).zip(source.par_chunks(1 << 16)).for_each(|(t, s)| t.copy_from_slice(s));
        best = best.min(begin.elapsed().as_secs_f64());
    }
    16.0 * source.len() as f64 / best
}

/// The same for a copy between two buffers of the adapter that a run would use.
fn device_copy_bandwidth() -> Result<f64, String> {
    let adapter = choose(Want::Gpu, None)?.ok_or("no adapter")?;
    let opened = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()));
    let (device, queue) = opened.map_err(|error| error.to_string())?;
    let size = 1 << 28;
    let usage = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    let buffer = || device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let (source, target) = (buffer(), buffer());
    let copies = 8;
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        (0..copies).for_each(|_| encoder.copy_buffer_to_buffer(&source, 0, &target, 0, size));
        let begin = Instant::now();
        queue.submit([encoder.finish()]);
        device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| error.to_string())?;
        best = best.min(begin.elapsed().as_secs_f64());
    }
    Ok(2.0 * (size * copies) as f64 / best)
}

/// `time` is when the measurement begins. Lists are not made anew in it: see how often a run does so.
fn bench(scene: &Scene, time: f64, choice: &Choice, name: &str) -> Result<(), String> {
    let count = scene.particles.len() as f64;
    if !(0.0..scene.file.duration).contains(&time) {
        return Err(format!("--time must lie between 0 and the scene's duration {}, found {time}", scene.file.duration));
    }
    let mut backend = open(scene, choice)?;
    if time > 0.0 {
        backend.begin_segment(0.0, time, u32::MAX, true)?;
        while backend.advance()?.running == 1 {}
    }
    backend.begin_segment(time, scene.file.duration - time, u32::MAX, time == 0.0)?;
    // A first look warms caches and compiles shaders.
    let warm = backend.advance()?;
    let (mut wall, mut busy, mut seen) = (f64::INFINITY, f64::INFINITY, warm.steps_done);
    for _ in 0..ROUNDS {
        let (begin, used) = (Instant::now(), processor_seconds());
        let clock = backend.advance()?;
        let steps = f64::from(clock.steps_done - seen);
        seen = clock.steps_done;
        wall = wall.min(begin.elapsed().as_secs_f64() / steps);
        busy = busy.min((processor_seconds() - used) / steps);
    }
    let neighbors = backend.fetch(&[Field::NeighborCount])?[&Field::NeighborCount].iter().sum::<f64>() / count;
    println!("\n{count} particles, {name}, {neighbors:.1} neighbours in reach, {}", backend.describe());
    println!("{:.0} bytes a particle", backend.bytes() as f64 / count);
    println!("step {:.3} ms: {:.3e} particle-updates a second, {:.3e} a core-second", wall * 1e3, count / wall, count / busy);
    let bandwidth = if *choice == Choice::Cpu { copy_bandwidth() } else { device_copy_bandwidth()? };
    // Each particle's tables once in and once out is the least that a step can move.
    let least = backend.bytes() as f64 / wall;
    println!(
        "tables once a step: {:.2} GB/s, {:.0} % of a copy's {:.1} GB/s",
        least / 1e9,
        100.0 * least / bandwidth,
        bandwidth / 1e9
    );
    table(&mut *backend, scene, count)
}

fn table(backend: &mut dyn Backend, scene: &Scene, count: f64) -> Result<(), String> {
    let calls = step::step(&scene.method);
    let times = backend.time_passes(&calls, 3)?;
    println!("{:<20} {:>10} {:>14}", "pass", "ms", "ns a particle");
    for (name, seconds) in &times {
        println!("{name:<20} {:>10.3} {:>14.2}", seconds * 1e3, seconds / count * 1e9);
    }
    let whole: f64 = times.iter().map(|(_, seconds)| seconds).sum();
    let touching = calls.iter().zip(&times).filter(|(call, _)| call.pass.is_contact(&scene.method));
    let contact: f64 = touching.map(|(_, (_, seconds))| seconds).sum();
    if contact > 0.0 {
        println!("contact: {:.0} % of the step", 100.0 * contact / whole);
    }
    Ok(())
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|w| w != "--bench").collect();
    let gpu = words.iter().any(|w| w == "--gpu");
    let after = |key: &str| words.iter().position(|w| w == key).and_then(|k| words.get(k + 1)).cloned();
    let choice = if gpu { Choice::Gpu(None) } else { Choice::Cpu };
    if let Some(path) = after("--scene") {
        let time = after("--time").map_or(Ok(0.0), |text| text.parse().map_err(|_| format!("--time {text} is not a number")));
        let scene = Scene::open(path.as_ref(), after("--variant").as_deref(), &[]);
        let done = time.and_then(|time| scene.and_then(|scene| bench(&scene, time, &choice, &scene.label())));
        if let Err(error) = done {
            eprintln!("{path}: {error}");
        }
        return;
    }
    let method = after("--method").unwrap_or_else(|| "elastic".into());
    let mut sizes: Vec<usize> = words.iter().filter_map(|w| w.parse().ok()).collect();
    if sizes.is_empty() {
        sizes = vec![10_000, 100_000];
    }
    for size in sizes {
        if let Err(error) = bench(&scene(size, &method), 0.0, &choice, &method) {
            eprintln!("{size} particles: {error}");
        }
    }
}
