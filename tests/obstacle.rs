//! Distances to rigid obstacles in the shader against their twin, and the structure against its mirror.

use crate::common::{Random, adapter};
use glam::DVec3;
use lithosph::backend::shader::{Choice, compose_text, offsets};
use lithosph::obstacle::{BERKOVICH, ObstacleKind, distance};
use lithosph::rows::Obstacle;
use lithosph::tensor::{Line, Plane, Solid, Space};
use std::mem::offset_of;
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{BufferDescriptor, BufferUsages};

const COUNT: usize = 4096;
const SHADER: &str = "
#import obstacle
@group(0) @binding(_) var<storage, read> obstacles: array<Obstacle>;
@group(0) @binding(_) var<storage, read> places: array<vec4<real>>;
@group(0) @binding(_) var<storage, read_write> found: array<vec4<real>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let place = places[id.x];
    let nearest = obstacle_distance(obstacles[id.y], vec_of(place.x, place.y, place.z));
    found[id.y * arrayLength(&places) + id.x] = vec4<real>(vec_to(nearest.normal), nearest.gap);
}
";

fn text(dimension: usize) -> String {
    compose_text("obstacle_test", SHADER, &Choice { flags: &[], dimension, smoothing: "", potentials: &[], laws: &[] })
}

#[test]
fn obstacles_mirror_the_shader_s() {
    macro_rules! members {
        ($($member:ident),*) => {{
            let Obstacle::<f32> { $($member: _),* } = Obstacle::default();
            vec![$((stringify!($member).to_string(), offset_of!(Obstacle<f32>, $member) as u32)),*]
        }};
    }
    let host =
        members!(kind, padding, point_x, point_y, point_z, axis_x, axis_y, axis_z, turn_x, turn_y, turn_z, radius, cosine, sine);
    for dimension in 1..=3 {
        assert_eq!(offsets(&text(dimension), "Obstacle").unwrap(), host);
    }
    // The last member is a number of 4 bytes, and nothing in it aligns the shader's structure to more.
    assert_eq!(size_of::<Obstacle<f32>>(), offset_of!(Obstacle<f32>, sine) + 4);
}

/// Normal and gap of every place for every obstacle, as the device finds them.
fn on_device(adapter: &wgpu::Adapter, dimension: usize, obstacles: &[Obstacle<f32>], places: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default())).unwrap();
    // SAFETY: numbers of 4 bytes without padding between them.
    let bytes = unsafe { std::slice::from_raw_parts(obstacles.as_ptr().cast::<u8>(), size_of_val(obstacles)) };
    let input =
        |contents| device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage: BufferUsages::STORAGE });
    let size = (obstacles.len() * places.len() * 16) as u64;
    let buffer = |usage| device.create_buffer(&BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let found = buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
    let staging = buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST);
    let module = wgpu::ShaderModuleDescriptor { label: None, source: wgpu::ShaderSource::Wgsl(text(dimension).into()) };
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &device.create_shader_module(module),
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    let buffers = [&input(bytes), &input(bytemuck::cast_slice(places)), &found];
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
        .collect();
    let layout = pipeline.get_bind_group_layout(0);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups((places.len() / 64) as u32, obstacles.len() as u32, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&found, 0, &staging, 0, size);
    queue.submit([encoder.finish()]);
    staging.slice(..).map_async(wgpu::MapMode::Read, |result| result.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    bytemuck::cast_slice(&staging.slice(..).get_mapped_range().unwrap()).to_vec()
}

fn twin<S: Space>(obstacle: &Obstacle<S::Real>, place: [f32; 4]) -> [f64; 4] {
    let (gap, normal) = distance::<S>(obstacle, S::vec_from([place[0], place[1], place[2]].map(f64::from)));
    let [x, y, z] = S::vec_to(normal);
    [x, y, z, lithosph::tensor::Real::f64(gap)]
}

/// Largest error of normal and gap against the twin in f64, which is given the same numbers.
fn worst(found: impl Iterator<Item = [f64; 4]>, exact: &[[f64; 4]]) -> f64 {
    let pairs = found.zip(exact).flat_map(|(found, exact)| (0..4).map(move |k| (found[k] - exact[k]).abs()));
    pairs.fold(0.0, f64::max)
}

fn agree<W: Space<Real = f64>, N: Space<Real = f32>>(adapter: &wgpu::Adapter) {
    let mut random = Random(7);
    let places: Vec<[f32; 4]> = (0..COUNT).map(|_| [0; 4].map(|_| 2.0 * random.signed() as f32)).collect();
    let mut direction = || DVec3::new(random.signed(), random.signed(), random.signed());
    let [axis, turn] = match N::DIMENSION {
        1 => [DVec3::X, DVec3::Y],
        2 => [direction().with_z(0.0), DVec3::Z],
        _ => [direction(), direction()],
    };
    let kinds = ObstacleKind::ALL.iter().filter(|kind| kind.fits(N::DIMENSION));
    let obstacles: Vec<Obstacle<f32>> =
        kinds.map(|&kind| Obstacle::new(kind, DVec3::ZERO, [axis, turn], 1.3, BERKOVICH).cast()).collect();
    let found = on_device(adapter, N::DIMENSION, &obstacles, &places);
    for (obstacle, found) in obstacles.iter().zip(found.chunks(COUNT)) {
        let exact: Vec<[f64; 4]> = places.iter().map(|&place| twin::<W>(&widened(obstacle), place)).collect();
        let device = worst(found.iter().map(|numbers| numbers.map(f64::from)), &exact);
        let single = worst(places.iter().map(|&place| twin::<N>(obstacle, place)), &exact);
        // The rule of tests/backend/parity: four times the twin's error in f32, two ulp of the largest number at least.
        let bound = (4.0 * single).max(2.0 * 3.5 * f64::from(f32::EPSILON));
        println!("{}D {}: device {device:e}, twin {single:e}", N::DIMENSION, ObstacleKind::ALL[obstacle.kind as usize].name());
        assert!(
            device <= bound,
            "{}D {:?}: {device:e}, twin {single:e}",
            N::DIMENSION,
            ObstacleKind::ALL[obstacle.kind as usize]
        );
    }
}

/// The same numbers in f64.
fn widened(obstacle: &Obstacle<f32>) -> Obstacle<f64> {
    let Obstacle { kind, padding, .. } = *obstacle;
    Obstacle {
        kind,
        padding,
        point_x: 0.0,
        point_y: 0.0,
        point_z: 0.0,
        axis_x: obstacle.axis_x.into(),
        axis_y: obstacle.axis_y.into(),
        axis_z: obstacle.axis_z.into(),
        turn_x: obstacle.turn_x.into(),
        turn_y: obstacle.turn_y.into(),
        turn_z: obstacle.turn_z.into(),
        radius: obstacle.radius.into(),
        cosine: obstacle.cosine.into(),
        sine: obstacle.sine.into(),
    }
}

#[test]
fn the_shader_finds_the_distances_of_its_twin() {
    let Some(adapter) = adapter() else { return };
    agree::<Line<f64>, Line<f32>>(&adapter);
    agree::<Plane<f64>, Plane<f32>>(&adapter);
    agree::<Solid<f64>, Solid<f32>>(&adapter);
}
