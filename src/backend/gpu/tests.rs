//! The machinery: with toy shaders in the passes' place, then with the true ones against their twins. Each
//! pass alone is compared in tests/backend/parity.

use super::*;
use crate::backend::cpu::Cpu;
use crate::backend::device::{Want, choose};
use crate::fields::Columns;
use crate::material::Law;
use crate::method::Method;
use crate::pass::{Pass, Stage};
use crate::rows::Body;
use crate::smoothing::Smoothing;
use crate::tensor::{Plane, Tuple};

/// A square lattice of spacing 1 with a velocity that varies, in an order that is not that of the cells.
fn state(side: usize) -> State<Plane<f32>> {
    let (method, count, cells) = (Method::default(), side * side, side / 2 + 5);
    let params = Params {
        count: count as u32,
        list_capacity: 40,
        cells_x: cells as u32,
        cells_y: cells as u32,
        cells_z: 1,
        cell_total: (cells * cells) as u32,
        body_count: 1,
        origin_x: -4.0,
        origin_y: -4.0,
        cell_x: 2.6,
        cell_y: 2.6,
        cell_z: 2.6,
        normalisation: Smoothing::CubicSpline.normalisation(2) as f32,
        reach: 2.55,
        slack: 0.05,
        cfl: 0.3,
        ..Params::default()
    };
    let mut columns = Columns::allocate(params.counts(), &step::fields(&method));
    for i in 0..count {
        let place = (i * 7919) % count;
        let (x, y) = ((place % side) as f32, (place / side) as f32);
        columns.number[i] = i as u32;
        columns.reference_position[i] = Tuple([x, y]);
        columns.reference_volume[i] = 1.0;
        columns.velocity[i] = Tuple([1e-2 * (0.3 * y).sin(), 1e-2 * (0.4 * x).cos()]);
    }
    let body =
        Body { density: 1.0, bulk_modulus: 1.0, shear_modulus: 0.5, sound_speed: 1.2, smoothing_length: 1.2, ..Body::default() };
    let body = body.with(Law::Linear, &[]).with(Law::Elastic, &[]);
    State {
        method,
        params,
        clock: Clock::default(),
        group_clocks: Vec::new(),
        bodies: vec![body],
        body_options: Vec::new(),
        coupling: vec![1.0],
        constraints: Vec::new(),
        course: Vec::new(),
        columns,
        bond_table: Default::default(),
        facet_pairs: Vec::new(),
        obstacles: Vec::new(),
        movers: Vec::new(),
        obstacle_pairs: Vec::new(),
        contact_pairs: Vec::new(),
        balance: Default::default(),
    }
}

const HEADER: &str = "
    struct Clock { start: f32, elapsed: f32, carry: f32, step: f32, duration: f32, steps_left: u32, steps_done: u32,
        running: u32, rebuild: u32, lists_built: u32, changes: u32, held: f32, arrived: u32, fault: u32, residual: f32 }
    struct Params { planes: array<vec4<f32>, 3>, count: u32, first: u32, chunk: u32, list_capacity: u32 }
    @group(0) @binding(0) var<uniform> params: Params;
    struct At { @builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
        @builtin(local_invocation_index) local: u32 }
    fn index(at: At, size: u32) -> u32 { return (at.group.x + at.group.y * at.groups.x) * size + at.local; }";

const MOVE: &str = "
    override stage_time: f32 = 7.0;
    @group(0) @binding(1) var<storage, read> velocity: array<vec2<f32>>;
    @group(0) @binding(2) var<storage, read_write> displacement: array<vec2<f32>>;
    @compute @workgroup_size(1) fn main(at: At) {
        let i = index(at, 1u);
        if i < params.count { displacement[i] += velocity[i] * stage_time; }
    }";

/// Entry k of a particle's row is its number plus k.
const LIST: &str = "
    @group(0) @binding(1) var<storage, read_write> neighbors: array<u32>;
    @group(0) @binding(2) var<storage, read_write> neighbor_count: array<u32>;
    @compute @workgroup_size(64) fn main(at: At) {
        let row = index(at, 64u);
        if row >= params.chunk { return; }
        let i = params.first + row;
        neighbor_count[i] = i % params.list_capacity;
        for (var k = 0u; k < i % params.list_capacity; k++) { neighbors[k * params.chunk + row] = i + k; }
    }";

const REVERSE: &str = "
    override words: u32 = 1u;
    @group(0) @binding(1) var<storage, read> source: array<u32>;
    @group(0) @binding(2) var<storage, read_write> destination: array<u32>;
    @compute @workgroup_size(64) fn main(at: At) {
        let i = index(at, 64u);
        if i >= params.count { return; }
        for (var k = 0u; k < words; k++) { destination[i * words + k] = source[(params.count - 1u - i) * words + k]; }
    }";

const TICK: &str = "
    @group(0) @binding(1) var<storage, read_write> clock: Clock;
    @compute @workgroup_size(256) fn blocks(at: At) {}
    @compute @workgroup_size(256) fn clock_(at: At) {
        if at.local != 0u || clock.running == 0u { return; }
        if clock.step > 0.0 { clock.elapsed += clock.step; clock.steps_done += 1u; clock.steps_left -= 1u; }
        clock.step = 0.125;
        if clock.steps_left == 0u || clock.elapsed >= clock.duration { clock.running = 0u; }
    }";

fn toy(pass: Pass, _: String) -> String {
    let entry = |entry: &crate::pass::Entry| format!("@compute @workgroup_size(64) fn {}() {{}}\n", entry.name);
    match pass {
        Pass::Drift => [HEADER, MOVE].concat(),
        Pass::FindNeighbors => [HEADER, LIST].concat(),
        Pass::Reorder => [HEADER, REVERSE].concat(),
        // An entry point and a variable may not share a name.
        Pass::BoundTimeStep => [HEADER, TICK].concat().replace("clock_", pass.entries()[1].name),
        _ => pass.entries().iter().map(entry).collect(),
    }
}

/// None where no adapter exists: the machine then has nothing to test.
fn toy_gpu(state: &State<Plane<f32>>, longest_part: Option<u32>) -> Option<Gpu> {
    let adapter = choose(Want::Gpu, None).ok()??;
    let options = Options { longest_part, patch: Some(Box::new(toy)) };
    Some(Gpu::with_options(&adapter, state, options).unwrap())
}

fn at(pass: Pass, time: f64) -> Call {
    Call { pass, stage: Stage { time, ..Stage::default() } }
}

#[test]
fn dispatches_beyond_the_limit_reach_every_particle_with_the_stage_s_constants() {
    let state = state(300);
    let Some(mut gpu) = toy_gpu(&state, None) else { return };
    gpu.run_calls(&[at(Pass::Drift, 0.5), at(Pass::Drift, 0.25)]).unwrap();
    let seen = gpu.fetch(&[Field::Displacement, Field::Number]).unwrap();
    let velocity: &[f32] = bytemuck::cast_slice(state.columns.bytes(Field::Velocity));
    assert_eq!(seen[&Field::Displacement].len(), velocity.len());
    for (u, &v) in seen[&Field::Displacement].iter().zip(velocity) {
        assert!((u - 0.75 * f64::from(v)).abs() < 1e-8);
    }
    assert_eq!(seen[&Field::Number][89_999], 89_999.0);
}

#[test]
fn a_split_neighbour_list_reads_as_a_whole_one() {
    let state = state(30);
    let Some(mut whole) = toy_gpu(&state, None) else { return };
    let Some(mut split) = toy_gpu(&state, Some(128)) else { return };
    assert_eq!((whole.parts(), split.parts()), (1, 8));
    for gpu in [&mut whole, &mut split] {
        gpu.run_calls(&[at(Pass::FindNeighbors, 0.0)]).unwrap();
        let lists = gpu.fetch_neighbors().unwrap();
        assert_eq!(lists.len(), 900);
        for (i, list) in lists.iter().enumerate() {
            assert_eq!(*list, (i..i + i % 40).map(|entry| entry as u32).collect::<Vec<_>>());
        }
    }
    let rows: Vec<u32> = (0..900 * 40).map(|k| k * 3).collect();
    split.write_table("neighbors", bytemuck::cast_slice(&rows)).unwrap();
    assert_eq!(split.read_table("neighbors").unwrap(), bytemuck::cast_slice::<u32, u8>(&rows));
}

#[test]
fn every_carried_field_is_reordered() {
    let state = state(20);
    let Some(mut gpu) = toy_gpu(&state, None) else { return };
    let mut wanted = state.columns.clone();
    wanted.reorder(&(0..400).rev().collect::<Vec<u32>>());
    gpu.run_calls(&[at(Pass::Reorder, 0.0)]).unwrap();
    let saved = gpu.save().unwrap().remove(0);
    assert!(saved.len() >= 8 && saved.contains_key(&Field::DeviatoricStress));
    for (field, bytes) in &saved {
        assert_eq!(bytes, wanted.bytes(*field), "{}", field.name());
    }
    gpu.load(&[Saved::from([(Field::Velocity, state.columns.bytes(Field::Velocity).to_vec())])]).unwrap();
    assert_eq!(gpu.read_table("velocity").unwrap(), state.columns.bytes(Field::Velocity));
    assert!(gpu.write_table("velocity", &[0; 4]).is_err() && gpu.read_table("nothing").is_err());
}

#[test]
fn host_and_device_take_the_bytes_of_the_list() {
    let mut state = state(20);
    state.method.internal_energy = true;
    state.columns = Columns::allocate(state.params.counts(), &step::fields(&state.method));
    let Some(gpu) = toy_gpu(&state, Some(128)) else { return };
    let listed = state.params.counts().bytes(&step::fields(&state.method), 2, 4);
    assert_eq!((gpu.tables().column_bytes(), state.bytes()), (listed, listed));
    let neighbors: u64 = gpu.tables().parts.iter().map(|part| part.neighbors.size()).sum();
    assert_eq!(neighbors, (state.columns.bytes(Field::Neighbors).len() as u64).next_multiple_of(16));
    assert!(gpu.bytes() >= listed);
}

#[test]
fn segments_end_on_time_and_keep_their_counts() {
    let Some(mut gpu) = toy_gpu(&state(10), None) else { return };
    gpu.begin_segment(5.0, 2.0, 1000, true).unwrap();
    let clock = gpu.advance().unwrap();
    assert_eq!((clock.start, clock.elapsed, clock.steps_done, clock.running), (5.0, 2.0, 16, 0));
    gpu.begin_segment(7.0, 1e9, 3, false).unwrap();
    let clock = gpu.advance().unwrap();
    assert_eq!((clock.elapsed, clock.steps_done, clock.steps_left, clock.running), (0.375, 19, 0, 0));
    gpu.set_clocks(&[Clock { steps_done: 100, ..Clock::default() }]).unwrap();
    gpu.begin_segment(7.0, 0.25, 3, false).unwrap();
    assert_eq!(gpu.advance().unwrap().steps_done, 102);
}

#[test]
fn timing_tells_each_call_and_leaves_the_clock() {
    let Some(mut gpu) = toy_gpu(&state(30), None) else { return };
    gpu.begin_segment(0.0, 1e9, 1000, false).unwrap();
    let before = gpu.read_clock().unwrap();
    let calls = step::step(&Method::default());
    let times = gpu.time_passes(&calls, 2).unwrap();
    let names: Vec<&str> = times.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, calls.iter().map(|call| call.pass.name()).collect::<Vec<_>>());
    assert!(times.iter().all(|(_, seconds)| seconds.is_finite() && *seconds >= 0.0));
    assert_eq!(gpu.read_clock().unwrap(), before);
}

#[test]
fn a_lost_device_is_an_error() {
    let Some(mut gpu) = toy_gpu(&state(10), None) else { return };
    gpu.link.device.destroy();
    let end = gpu.begin_segment(0.0, 1.0, 10, true).and_then(|()| gpu.advance()).and_then(|_| gpu.advance());
    assert!(end.is_err() && gpu.fetch(&[Field::Velocity]).is_err());
}

#[test]
fn a_shader_that_does_not_compile_is_an_error_that_names_it() {
    let Some(adapter) = choose(Want::Gpu, None).ok().flatten() else { return };
    let broken = |pass, text| if pass == Pass::Kick { "fn main( {".to_string() } else { toy(pass, text) };
    let options = Options { longest_part: None, patch: Some(Box::new(broken)) };
    let message = Gpu::with_options(&adapter, &state(10), options).err().unwrap();
    assert!(message.starts_with("shader kick: "), "{message}");
}

#[test]
fn a_table_that_does_not_fit_is_an_error_that_names_it() {
    let Some(adapter) = choose(Want::Gpu, None).ok().flatten() else { return };
    let mut state = state(10);
    state.params.cell_total = u32::MAX;
    let message = Gpu::new(&adapter, &state).err().unwrap();
    assert!(message.starts_with("the table cell_count of 100 particles takes 17.18 GB but "), "{message}");
}

/// As the run loop does it: two segments, then the fields.
fn two_segments(backend: &mut dyn Backend) -> (Fetched, Clock<f64>) {
    let mut clock = Clock::default();
    for (start, first) in [(0.0, true), (8.0, false)] {
        backend.begin_segment(start, 8.0, u32::MAX, first).unwrap();
        clock = backend.advance().unwrap();
        while clock.running == 1 {
            clock = backend.advance().unwrap();
        }
    }
    (backend.fetch(&[Field::Number, Field::Displacement, Field::Velocity, Field::DeviatoricStress]).unwrap(), clock)
}

#[test]
fn a_run_agrees_with_the_twins_and_does_not_depend_on_the_split() {
    let Some(adapter) = choose(Want::Gpu, None).ok().flatten() else { return };
    let host = state(24);
    let (gpu, whole_clock) = two_segments(&mut Gpu::new(&adapter, &host).unwrap());
    let options = Options { longest_part: Some(100), patch: None };
    let (split, split_clock) = two_segments(&mut Gpu::with_options(&adapter, &host, options).unwrap());
    assert_eq!((&gpu, whole_clock), (&split, split_clock));

    let (cpu, cpu_clock) = two_segments(&mut Cpu::new(host));
    assert_eq!(gpu[&Field::Number], cpu[&Field::Number]);
    let counts = |clock: Clock<f64>| (clock.steps_done, clock.lists_built, clock.fault, clock.start);
    assert_eq!(counts(whole_clock), counts(cpu_clock));
    assert!(whole_clock.steps_done > 50 && whole_clock.lists_built > 2);
    for field in [Field::Displacement, Field::Velocity, Field::DeviatoricStress] {
        let largest = cpu[&field].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let error = gpu[&field].iter().zip(&cpu[&field]).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        assert!(largest > 0.0 && error < 1e-4 * largest, "{}: {error} of {largest}", field.name());
    }
}
