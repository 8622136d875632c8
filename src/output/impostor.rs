//! The painter for a GPU: one instanced square per particle, off screen.
//!
//! Camera, colours and light are those of [`super::splat`]; a test holds the two pictures together.

use super::picture::{AMBIENT, DIFFUSE, Disc, LIGHT, Picture, View, compose};
use super::snapshot::Snapshot;
use image::RgbaImage;
use std::time::Duration;
use wgpu::util::DeviceExt;

const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Discs in a buffer: 24 MB, within the limits of any adapter.
const BATCH: usize = 1 << 20;
/// A software adapter takes a second for a million particles.
const TIMEOUT: Duration = Duration::from_secs(120);

/// The uniforms of `impostor.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Frame {
    size: [f32; 2],
    radius: f32,
    relief: f32,
    light: [f32; 4],
    ambient: f32,
    diffuse: f32,
    far: f32,
    near: f32,
}

/// Paints the snapshot with the given device, which needs no feature.
pub fn draw(device: &wgpu::Device, queue: &wgpu::Queue, snapshot: &Snapshot, view: &View) -> Result<RgbaImage, String> {
    let picture = compose(snapshot, view)?;
    let limit = device.limits().max_texture_dimension_2d;
    if picture.samples().iter().any(|&side| side > limit) {
        return Err(format!("this adapter paints at most {limit} samples a side, not {:?}", picture.samples()));
    }
    let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let (buffer, row) = paint(device, queue, &picture);
    let error = pollster::block_on(memory.pop()).or(pollster::block_on(scope.pop()));
    if let Some(error) = error {
        return Err(format!("the adapter refuses the picture: {error}"));
    }
    Ok(picture.finish(&read_back(device, &buffer, &picture, row)?))
}

/// Encodes and submits the picture; gives the buffer it is copied to and the bytes of its rows.
fn paint(device: &wgpu::Device, queue: &wgpu::Queue, picture: &Picture) -> (wgpu::Buffer, u32) {
    let [width, height] = picture.samples();
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let colour = target(device, size, COLOUR);
    let depth = target(device, size, DEPTH);
    let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("impostor samples"),
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("impostor") });
    fill(device, &mut encoder, picture, &colour, &depth);
    encoder.copy_texture_to_buffer(
        colour.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
        },
        size,
    );
    queue.submit([encoder.finish()]);
    (buffer, row)
}

fn target(device: &wgpu::Device, size: wgpu::Extent3d, format: wgpu::TextureFormat) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("impostor target"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

fn fill(
    device: &wgpu::Device,
    encoder: &mut wgpu::CommandEncoder,
    picture: &Picture,
    colour: &wgpu::Texture,
    depth: &wgpu::Texture,
) {
    let pipeline = pipeline(device);
    let frame = uniforms(device, picture, &pipeline);
    let batches: Vec<_> = picture.discs.chunks(BATCH).map(|discs| (batch(device, discs), discs.len() as u32)).collect();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("impostor"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &colour.create_view(&wgpu::TextureViewDescriptor::default()),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth.create_view(&wgpu::TextureViewDescriptor::default()),
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    let [left, top, right, bottom] = picture.scissor();
    pass.set_scissor_rect(left, top, right - left, bottom - top);
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &frame, &[]);
    for (discs, count) in &batches {
        pass.set_vertex_buffer(0, discs.slice(..));
        pass.draw(0..4, 0..*count);
    }
}

fn batch(device: &wgpu::Device, discs: &[Disc]) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("impostor discs"),
        contents: bytemuck::cast_slice(discs),
        usage: wgpu::BufferUsages::VERTEX,
    })
}

fn uniforms(device: &wgpu::Device, picture: &Picture, pipeline: &wgpu::RenderPipeline) -> wgpu::BindGroup {
    let [near, far] = picture.depth();
    let [x, y, z] = LIGHT;
    let frame = Frame {
        size: picture.samples().map(|side| side as f32),
        radius: picture.radius,
        relief: picture.relief,
        light: [x, y, z, 0.0],
        ambient: AMBIENT,
        diffuse: DIFFUSE,
        far,
        near,
    };
    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("impostor frame"),
        contents: bytemuck::bytes_of(&frame),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("impostor frame"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
    })
}

fn pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let source = include_str!("../../shaders/render/impostor.wgsl");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("impostor"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let disc = wgpu::VertexBufferLayout {
        array_stride: size_of::<Disc>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("impostor"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(disc)],
        },
        primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..wgpu::PrimitiveState::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(COLOUR.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Waits for the picture and drops the padding of its rows.
fn read_back(device: &wgpu::Device, buffer: &wgpu::Buffer, picture: &Picture, row: u32) -> Result<Vec<[u8; 4]>, String> {
    let (send, receive) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver is gone only after a timeout, when no one wants the answer.
        let _ = send.send(result);
    });
    let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(TIMEOUT) };
    device.poll(wait).map_err(|error| format!("the adapter does not finish the picture: {error}"))?;
    let mapped = receive.try_recv().map_err(|_| "the adapter does not hand out the picture".to_string())?;
    mapped.map_err(|error| format!("cannot read the picture back: {error}"))?;
    let bytes = buffer.get_mapped_range(..).map_err(|error| format!("cannot read the picture back: {error}"))?;
    let rows = bytes.chunks_exact(row as usize).map(|padded| &padded[..4 * picture.samples()[0] as usize]);
    Ok(rows.flat_map(|row| row.as_chunks::<4>().0).copied().collect())
}

#[cfg(test)]
mod tests {
    use super::super::samples::{bar, cube, ring, view};
    use super::super::splat::splat;
    use super::*;

    fn device() -> Option<(wgpu::Device, wgpu::Queue)> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let options = wgpu::RequestAdapterOptions::default();
        let adapter = pollster::block_on(instance.request_adapter(&options)).ok()?;
        println!("adapter: {}", adapter.get_info().name);
        let wanted = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
        pollster::block_on(adapter.request_device(&wanted)).ok()
    }

    /// Mean absolute difference of a channel, and the part of pixels with a channel off by over 40.
    fn difference(a: &RgbaImage, b: &RgbaImage) -> (f64, f64) {
        let apart = |(a, b): (&u8, &u8)| f64::from(a.abs_diff(*b));
        let mean = a.iter().zip(b.iter()).map(apart).sum::<f64>() / a.len() as f64;
        let far = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| (0..3).any(|k| a[k].abs_diff(b[k]) > 40);
        (mean, a.pixels().zip(b.pixels()).filter(far).count() as f64 / a.pixels().len() as f64)
    }

    #[test]
    fn both_painters_give_the_same_picture() {
        let Some((device, queue)) = device() else {
            println!("no adapter at all: the painters are not compared");
            return;
        };
        // 1000 x 700 needs padding at read-back.
        let small = |field: &str| View { width: 1000, height: 700, ..view(field) };
        for (shot, field) in [(ring(), "pressure"), (cube(20), "von_mises"), (bar(), "pressure")] {
            let gpu = draw(&device, &queue, &shot, &small(field)).unwrap();
            let (mean, far) = difference(&gpu, &splat(&shot, &small(field)).unwrap());
            println!("dimension {}: mean {mean:.4} of 255, {:.3} % off by over 40", shot.dimension, 100.0 * far);
            assert!(mean < 2.0 && far <= 0.01, "dimension {}: {mean} {far}", shot.dimension);
            if let Some(folder) = std::env::var_os("LITHOSPH_KEEP") {
                let name = format!("impostor-{}d.png", shot.dimension);
                super::super::save_png(&std::path::Path::new(&folder).join(name), &gpu).unwrap();
            }
        }
    }

    #[test]
    fn the_comparison_can_fail() {
        let pressure = splat(&ring(), &view("pressure")).unwrap();
        let other = splat(&ring(), &view("position.y")).unwrap();
        assert!(difference(&pressure, &other).1 > 0.01);
    }

    #[test]
    fn a_picture_beyond_the_limits_is_an_error() {
        let Some((device, queue)) = device() else {
            println!("no adapter at all: its limits are not tested");
            return;
        };
        if device.limits().max_texture_dimension_2d < 16384 {
            let large = View { width: 8192, height: 200, ..view("pressure") };
            assert!(draw(&device, &queue, &ring(), &large).unwrap_err().contains("samples"));
        }
    }
}
