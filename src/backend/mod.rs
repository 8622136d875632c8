//! Where the passes run. The run loop ([`crate::run`]) knows only this trait.

pub mod cpu;
pub mod device;
pub mod frequency;
pub mod gpu;
mod machine;
mod scaled;
pub mod shader;

pub use machine::{Backend, Fetched, Saved};

use crate::complain::complain;
use crate::memory;
use crate::scene::Scene;
use crate::state::State;
use crate::tensor::{Line, Plane, Solid, Space};
use std::sync::Once;

/// Which backend a run is asked to use.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum Choice {
    /// The best hardware adapter, else the CPU.
    #[default]
    Auto,
    /// An adapter, a software one too, perhaps by part of its name.
    Gpu(Option<String>),
    Cpu,
    /// The CPU path in f32.
    Cpu32,
}

/// Opens the backend for a scene; says in one line on stderr where `Auto` found no GPU.
pub fn open(scene: &Scene, choice: &Choice) -> Result<Box<dyn Backend>, String> {
    let adapter = match choice {
        Choice::Auto if residual_of(scene) < LEAST_RESIDUAL => None,
        Choice::Auto => {
            let found = device::choose(device::Want::Auto, None)?;
            if found.is_none() {
                // The sentence is printed once, however many scenes are checked.
                static TOLD: Once = Once::new();
                TOLD.call_once(|| complain("no hardware GPU with Vulkan found: running on the CPU"));
            }
            found
        }
        Choice::Gpu(name) => {
            let found = device::choose(device::Want::Gpu, name.as_deref())?;
            Some(found.ok_or("no Vulkan adapter at all, not even a software one; --backend cpu runs without")?)
        }
        Choice::Cpu | Choice::Cpu32 => None,
    };
    budget(scene, adapter.as_ref(), choice)?;
    if (adapter.is_some() || *choice == Choice::Cpu32) && residual_of(scene) < LEAST_RESIDUAL {
        return Err(format!(
            "{}: quasi_static.residual is {:e}, and f32 does not reach below {LEAST_RESIDUAL:e}: run it on the CPU in f64",
            scene.label(),
            residual_of(scene)
        ));
    }
    match scene.dimension() {
        1 => machine::<Line<f64>, Line<f32>>(scene, choice, adapter),
        2 => machine::<Plane<f64>, Plane<f32>>(scene, choice, adapter),
        _ => machine::<Solid<f64>, Solid<f32>>(scene, choice, adapter),
    }
}

/// The CPU in the space `D`, or the adapter or the CPU in `F`.
fn machine<D: Space<Real = f64>, F: Space<Real = f32>>(
    scene: &Scene,
    choice: &Choice,
    adapter: Option<wgpu::Adapter>,
) -> Result<Box<dyn Backend>, String> {
    if adapter.is_none() && *choice != Choice::Cpu32 {
        return Ok(Box::new(cpu::Cpu::of_members(states::<D>(scene, false))));
    }
    let (mut members, units) = (states::<F>(scene, true), scaled::Units::of(scene));
    if let Some(units) = units {
        members.iter_mut().for_each(|member| units.scale(member));
    }
    let inner: Box<dyn Backend> = match adapter {
        Some(adapter) => Box::new(gpu::Gpu::of_members(&adapter, &members)?),
        None => Box::new(cpu::Cpu::of_members(members)),
    };
    Ok(match units {
        Some(units) => Box::new(scaled::Scaled::new(inner, units)),
        None => inner,
    })
}

/// The first states of all members of a run.
fn states<S: Space>(scene: &Scene, compensated: bool) -> Vec<State<S>> {
    let state = |member: &Scene| {
        let bound = frequency::of(member);
        let mut state = member.state::<S>(compensated);
        if let Some(bound) = bound {
            bound.give(&mut state);
        }
        state
    };
    scene.members().map(state).collect()
}

/// Smallest quasi_static.residual that f32 is trusted with: rounding of the strains alone leaves 1e-6 and more.
const LEAST_RESIDUAL: f64 = 1e-5;

fn residual_of(scene: &Scene) -> f64 {
    scene.file.quasi_static.as_ref().map_or(f64::INFINITY, |q| q.residual)
}

/// Refuses a scene whose tables do not fit: drivers overcommit, and fail later without a word.
fn budget(scene: &Scene, adapter: Option<&wgpu::Adapter>, choice: &Choice) -> Result<(), String> {
    let single = adapter.is_some() || *choice == Choice::Cpu32;
    let needed = scene.run_bytes(if single { 4 } else { 8 }, single);
    let device = adapter.map(device::DeviceInfo::of).filter(|info| !info.software).and_then(|info| info.memory);
    let Some(there) = device.or_else(memory::available) else { return Ok(()) };
    if needed <= there {
        return Ok(());
    }
    let gigabytes = |bytes: u64| bytes as f64 / 1e9;
    Err(format!(
        "{}: {} particles take {:.1} GB, and {:.1} GB are free: raise the spacing, or choose another device",
        scene.label(),
        scene.particles.len(),
        gigabytes(needed),
        gigabytes(there)
    ))
}
