//! Graphics adapters: which there are, what they can do, which one a run takes.

use std::sync::OnceLock;
use wgpu::{Adapter, DeviceType, Features};

/// What the user asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Want {
    /// The best hardware adapter, if there is one.
    Auto,
    /// Any adapter, a software one if there is no other.
    Gpu,
}

/// One adapter, for `lithosph devices`.
#[derive(Debug, Clone)]
pub struct DeviceInfo {
    pub name: String,
    pub backend: String,
    pub driver: String,
    pub driver_info: String,
    pub kind: &'static str,
    /// Done by the processor, not by graphics hardware.
    pub software: bool,
    /// Bytes of the largest memory heap of the device, where the driver tells.
    pub memory: Option<u64>,
    pub max_binding_bytes: u64,
    pub max_buffer_bytes: u64,
    pub max_storage_buffers: u32,
    pub max_workgroups: u32,
    pub f64: bool,
    /// Smallest and largest subgroup.
    pub subgroups: Option<(u32, u32)>,
    pub timestamps: bool,
}

impl DeviceInfo {
    pub fn of(adapter: &Adapter) -> Self {
        let (info, limits, features) = (adapter.get_info(), adapter.limits(), adapter.features());
        Self {
            name: info.name,
            backend: info.backend.to_string(),
            driver: info.driver,
            driver_info: info.driver_info,
            kind: kind(info.device_type),
            software: info.device_type == DeviceType::Cpu,
            memory: memory(adapter),
            max_binding_bytes: limits.max_storage_buffer_binding_size,
            max_buffer_bytes: limits.max_buffer_size,
            max_storage_buffers: limits.max_storage_buffers_per_shader_stage,
            max_workgroups: limits.max_compute_workgroups_per_dimension,
            f64: features.contains(Features::SHADER_F64),
            subgroups: (features.contains(Features::SUBGROUP)).then_some((info.subgroup_min_size, info.subgroup_max_size)),
            timestamps: features.contains(TIMESTAMPS),
        }
    }
}

/// Features that timing a pass on the device takes.
pub(super) const TIMESTAMPS: Features = Features::TIMESTAMP_QUERY.union(Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

fn kind(device_type: DeviceType) -> &'static str {
    match device_type {
        DeviceType::DiscreteGpu => "discrete GPU",
        DeviceType::IntegratedGpu => "integrated GPU",
        DeviceType::VirtualGpu => "virtual GPU",
        DeviceType::Cpu => "software",
        DeviceType::Other => "other",
    }
}

/// Larger is better; `None` where the processor would do the work, or nothing is known.
fn hardware_score(device_type: DeviceType) -> Option<u32> {
    match device_type {
        DeviceType::DiscreteGpu => Some(3),
        DeviceType::IntegratedGpu => Some(2),
        DeviceType::VirtualGpu => Some(1),
        DeviceType::Cpu | DeviceType::Other => None,
    }
}

/// Bytes of the largest heap on the device.
#[cfg(not(target_vendor = "apple"))]
fn memory(adapter: &Adapter) -> Option<u64> {
    // SAFETY: the handles are only read from, while `adapter` keeps them alive.
    unsafe {
        let raw = adapter.as_hal::<wgpu::hal::api::Vulkan>()?;
        let instance = raw.shared_instance().raw_instance();
        let properties = instance.get_physical_device_memory_properties(raw.raw_physical_device());
        let heaps = &properties.memory_heaps[..properties.memory_heap_count as usize];
        // Bit 0 is VK_MEMORY_HEAP_DEVICE_LOCAL_BIT.
        heaps.iter().filter(|heap| heap.flags.as_raw() & 1 != 0).map(|heap| heap.size).max()
    }
}
#[cfg(target_vendor = "apple")]
fn memory(_: &Adapter) -> Option<u64> {
    None
}

/// Adapters that can compute. Empty without a driver.
fn adapters() -> Vec<Adapter> {
    // One for the process: loading the drivers takes tens of milliseconds.
    static INSTANCE: OnceLock<wgpu::Instance> = OnceLock::new();
    let instance = INSTANCE.get_or_init(|| wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env()));
    let mut list = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let computes = |a: &Adapter| a.get_downlevel_capabilities().flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS);
    list.retain(computes);
    list
}

/// All adapters.
pub fn list() -> Vec<DeviceInfo> {
    adapters().iter().map(DeviceInfo::of).collect()
}

/// The adapter for a run; `None` means the CPU path, which only `Want::Auto` leads to.
///
/// A name, or part of one in any case, chooses among all adapters, software included.
///
/// # Errors
/// One sentence, if no adapter has the name, or the user wants one and there is none.
pub fn choose(want: Want, name: Option<&str>) -> Result<Option<Adapter>, String> {
    let adapters = adapters();
    let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
    let types: Vec<DeviceType> = adapters.iter().map(|a| a.get_info().device_type).collect();
    let place = pick(want, name, &names, &types)?;
    Ok(place.and_then(|place| adapters.into_iter().nth(place)))
}

fn pick(want: Want, name: Option<&str>, names: &[String], types: &[DeviceType]) -> Result<Option<usize>, String> {
    let matches = |k: &usize| match name {
        Some(name) => names[*k].to_lowercase().contains(&name.to_lowercase()),
        None => want == Want::Gpu || hardware_score(types[*k]).is_some(),
    };
    // Of equals the first: drivers list their preferred device first.
    let best = (0..names.len()).rev().filter(matches).max_by_key(|&k| hardware_score(types[k]));
    match (best, name, want) {
        (Some(k), _, _) => Ok(Some(k)),
        (None, Some(name), _) if names.is_empty() => Err(format!("no adapter is named {name}: no graphics driver was found")),
        (None, Some(name), _) => Err(format!("no adapter is named {name}; there are: {}", names.join(", "))),
        (None, None, Want::Auto) => Ok(None),
        (None, None, Want::Gpu) => {
            Err("no graphics adapter was found; install a Vulkan driver (Debian: mesa-vulkan-drivers) or use the CPU".into())
        }
    }
}

/// Keeps Mesa's device-selection layer from complaining on stderr where no desktop runs.
///
/// # Safety
/// Sets an environment variable: no other thread may run yet.
pub unsafe fn quiet_drivers() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: as the caller promises.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn listing_never_panics() {
        for device in list() {
            assert!(!device.name.is_empty() && device.max_workgroups > 0, "{device:?}");
        }
    }

    #[test]
    fn hardware_comes_first_and_software_only_when_asked_for() {
        let names = ["llvmpipe", "Iris", "GeForce A", "GeForce B"].map(String::from);
        let types = [DeviceType::Cpu, DeviceType::IntegratedGpu, DeviceType::DiscreteGpu, DeviceType::DiscreteGpu];
        assert_eq!(pick(Want::Auto, None, &names, &types), Ok(Some(2)));
        assert_eq!(pick(Want::Auto, None, &names[..2], &types[..2]), Ok(Some(1)));
        assert_eq!(pick(Want::Auto, None, &names[..1], &types[..1]), Ok(None));
        assert_eq!(pick(Want::Gpu, None, &names[..1], &types[..1]), Ok(Some(0)));
        assert_eq!(pick(Want::Auto, Some("LLVM"), &names, &types), Ok(Some(0)));
        assert_eq!(pick(Want::Auto, Some("geforce b"), &names, &types), Ok(Some(3)));
    }

    #[test]
    fn a_wrong_name_tells_the_right_ones() {
        let names = ["llvmpipe".to_string()];
        let message = pick(Want::Gpu, Some("Voodoo"), &names, &[DeviceType::Cpu]).unwrap_err();
        assert_eq!(message, "no adapter is named Voodoo; there are: llvmpipe");
        assert!(pick(Want::Gpu, None, &[], &[]).is_err());
        assert_eq!(pick(Want::Auto, None, &[], &[]), Ok(None));
    }
}
