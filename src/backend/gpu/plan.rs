//! From calls to commands: shaders, pipelines, bind groups and workgroup counts, all made once.

use super::connection::Connection;
use super::tables::{Part, Tables};
use crate::backend::shader::{self, Access, Binding, Interface, Shader};
use crate::fields::{REDUCTION_BLOCK, SCAN_BLOCK, Set};
use crate::method::Method;
use crate::pass::{Call, Domain, Entry, Pass};
use std::collections::BTreeMap;
use wgpu::{Buffer, CommandEncoder, ComputePassDescriptor, ComputePipeline};

/// Changes the composed text of a pass, so that a test can sabotage it.
pub type Patch = Box<dyn Fn(Pass, String) -> String + Send>;

/// One command for the device.
#[derive(Clone)]
pub enum Action {
    Dispatch {
        pipeline: ComputePipeline,
        bindings: wgpu::BindGroup,
        groups: (u32, u32),
    },
    /// Of each buffer the first byte that is copied.
    Copy {
        from: (Buffer, u64),
        to: (Buffer, u64),
        bytes: u64,
    },
}

/// Writes commands, keeping dispatches together in one compute pass; wgpu puts the barriers between them.
pub fn encode<'a>(encoder: &mut CommandEncoder, actions: impl IntoIterator<Item = &'a Action>) {
    let mut open: Option<wgpu::ComputePass<'static>> = None;
    for action in actions {
        match action {
            Action::Dispatch { pipeline, bindings, groups } => {
                let pass =
                    open.get_or_insert_with(|| encoder.begin_compute_pass(&ComputePassDescriptor::default()).forget_lifetime());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, bindings, &[]);
                pass.dispatch_workgroups(groups.0, groups.1, 1);
            }
            Action::Copy { from, to, bytes } => {
                open = None;
                encoder.copy_buffer_to_buffer(&from.0, from.1, &to.0, to.1, *bytes);
            }
        }
    }
}

/// Number of workgroups as a rectangle whose sides the device allows.
pub fn fold(groups: u32, limit: u32) -> (u32, u32) {
    let rows = groups.div_ceil(limit).max(1);
    (groups.div_ceil(rows), rows)
}

/// An entry point made ready for pipelines.
struct Prepared {
    interface: Interface,
    bindings: wgpu::BindGroupLayout,
    pipeline: wgpu::PipelineLayout,
}

struct Module {
    module: wgpu::ShaderModule,
    entries: BTreeMap<&'static str, Prepared>,
}

/// Override constants: names, and values as bits.
type Constants = Vec<(&'static str, u64)>;

/// Makes commands, and keeps what it made.
pub struct Planner {
    pub method: Method,
    patch: Option<Patch>,
    modules: BTreeMap<Pass, Module>,
    pipelines: BTreeMap<(Pass, &'static str, Constants), ComputePipeline>,
    made: Vec<(Call, Vec<Action>)>,
}

impl Planner {
    pub fn new(method: &Method, patch: Option<Patch>) -> Self {
        let (modules, pipelines) = (BTreeMap::new(), BTreeMap::new());
        Self { method: method.clone(), patch, modules, pipelines, made: Vec::new() }
    }

    /// Commands of calls in order.
    pub fn actions(&mut self, link: &Connection, tables: &Tables, calls: &[Call]) -> Result<Vec<Action>, String> {
        let mut all = Vec::new();
        for call in calls {
            if !self.made.iter().any(|(made, _)| made == call) {
                let actions = self.make(link, tables, call)?;
                self.made.push((*call, actions));
            }
            all.extend(self.made.iter().filter(|(made, _)| made == call).flat_map(|(_, actions)| actions.clone()));
        }
        Ok(all)
    }

    fn make(&mut self, link: &Connection, tables: &Tables, call: &Call) -> Result<Vec<Action>, String> {
        let name = call.pass.name();
        let located = |error: String| format!("shader {name}: {error}");
        if !self.modules.contains_key(&call.pass) {
            let module = self.compile(link, call.pass).map_err(located)?;
            self.modules.insert(call.pass, module);
        }
        let mut actions = Vec::new();
        if call.pass == Pass::Reorder {
            for field in tables.carried().filter(|field| field.set() == Set::Particle) {
                let table = tables.field(field)?;
                let words = [("words", f64::from(tables.words(field)))];
                self.dispatch(link, tables, call, &words, &[("source", &table.buffer)], &mut actions)?;
                let (from, to) = (tables.scratch.buffer.clone(), table.buffer.clone());
                actions.push(Action::Copy { from: (from, 0), to: (to, 0), bytes: table.bytes });
            }
        } else {
            self.dispatch(link, tables, call, &[], &[], &mut actions)?;
        }
        link.check().map_err(located)?;
        Ok(actions)
    }

    fn compile(&self, link: &Connection, pass: Pass) -> Result<Module, String> {
        let mut text = shader::compose(pass, &self.method);
        if let Some(patch) = &self.patch {
            text = patch(pass, text);
        }
        let parsed = Shader::parse(&text)?;
        let checks = wgpu::ShaderRuntimeChecks { force_loop_bounding: false, ..wgpu::ShaderRuntimeChecks::checked() };
        let descriptor = wgpu::ShaderModuleDescriptor { label: Some(pass.name()), source: wgpu::ShaderSource::Wgsl(text.into()) };
        // SAFETY: every loop of this crate's shaders counts up to a bound read before it, so it ends; all
        // other checks are on.
        let module = unsafe { link.device.create_shader_module_trusted(descriptor, checks) };
        link.check()?;
        let prepare = |entry: &Entry| Ok((entry.name, Prepared::new(link, pass, parsed.entry(entry.name)?)?));
        Ok(Module { module, entries: pass.entries().iter().map(prepare).collect::<Result<_, String>>()? })
    }

    /// Adds the dispatches of all entry points of a call.
    fn dispatch(
        &mut self,
        link: &Connection,
        tables: &Tables,
        call: &Call,
        constants: &[(&'static str, f64)],
        special: &[(&str, &Buffer)],
        actions: &mut Vec<Action>,
    ) -> Result<(), String> {
        let module = &self.modules[&call.pass];
        for entry in call.pass.entries() {
            let prepared = &module.entries[entry.name];
            let wanted = call.stage.constants().into_iter().chain(constants.iter().copied());
            let constants: Constants = wanted
                .filter(|(name, _)| prepared.interface.overrides.iter().any(|known| known == name))
                .map(|(name, value)| (name, value.to_bits()))
                .collect();
            let pipeline = self
                .pipelines
                .entry((call.pass, entry.name, constants))
                .or_insert_with_key(|(pass, entry, constants)| prepared.pipeline(link, *pass, &module.module, entry, constants))
                .clone();
            let parts = if entry.domain == Domain::Listed { &tables.parts[..] } else { &tables.parts[..1] };
            for part in parts {
                let groups = groups(entry.domain, tables, part, prepared.interface.workgroup);
                if groups > 0 {
                    let bindings = prepared.bind(link, tables, part, entry.domain, special)?;
                    let groups = fold(groups, link.device.limits().max_compute_workgroups_per_dimension);
                    actions.push(Action::Dispatch { pipeline: pipeline.clone(), bindings, groups });
                }
            }
        }
        Ok(())
    }
}

/// Workgroups that cover a domain.
fn groups(domain: Domain, tables: &Tables, part: &Part, workgroup: u32) -> u32 {
    let params = &tables.params;
    match domain {
        Domain::Particles => params.count.div_ceil(workgroup),
        Domain::Listed => part.count.div_ceil(workgroup),
        Domain::Cells => params.cell_total.div_ceil(workgroup),
        Domain::Facets => params.facet_count.div_ceil(workgroup),
        Domain::FacetBlocks => params.counts().facet_blocks() as u32,
        Domain::ScanBlocks => params.cell_total.div_ceil(SCAN_BLOCK as u32),
        Domain::ReductionBlocks => params.count.div_ceil(REDUCTION_BLOCK as u32),
        Domain::One => 1,
    }
}

impl Prepared {
    fn new(link: &Connection, pass: Pass, interface: Interface) -> Result<Self, String> {
        let limit = link.device.limits().max_storage_buffers_per_shader_stage;
        let storage = interface.bindings.iter().filter(|binding| binding.kind != Access::Uniform).count();
        if storage > limit as usize {
            return Err(format!("it binds {storage} tables, but the device allows {limit}; use the CPU"));
        }
        if let Some(stray) = interface.bindings.iter().find(|binding| binding.group != 0) {
            return Err(format!("{} is not in group 0", stray.name));
        }
        let entries: Vec<_> = interface.bindings.iter().map(layout_entry).collect();
        let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(pass.name()), entries: &entries };
        let bindings = link.device.create_bind_group_layout(&descriptor);
        let pipeline = link.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(pass.name()),
            bind_group_layouts: &[Some(&bindings)],
            immediate_size: 0,
        });
        link.check()?;
        Ok(Self { interface, bindings, pipeline })
    }

    fn pipeline(
        &self,
        link: &Connection,
        pass: Pass,
        module: &wgpu::ShaderModule,
        entry: &str,
        constants: &Constants,
    ) -> ComputePipeline {
        let values: Vec<(&str, f64)> = constants.iter().map(|&(name, bits)| (name, f64::from_bits(bits))).collect();
        link.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(pass.name()),
            layout: Some(&self.pipeline),
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &values, ..Default::default() },
            cache: None,
        })
    }

    /// Binds the tables by the names of the shader's variables.
    fn bind(
        &self,
        link: &Connection,
        tables: &Tables,
        part: &Part,
        domain: Domain,
        special: &[(&str, &Buffer)],
    ) -> Result<wgpu::BindGroup, String> {
        let find = |binding: &Binding| match binding.name.as_str() {
            "params" => Ok(&part.params),
            "neighbors" if domain == Domain::Listed => Ok(&part.neighbors),
            "neighbors" => Err("it binds the neighbour list, so its domain must be Listed".to_string()),
            "destination" => Ok(&tables.scratch.buffer),
            name => match special.iter().find(|(known, _)| *known == name) {
                Some((_, buffer)) => Ok(*buffer),
                None => tables.get(name).map(|table| &table.buffer),
            },
        };
        let mut entries = Vec::new();
        for binding in &self.interface.bindings {
            let resource = find(binding)?.as_entire_binding();
            entries.push(wgpu::BindGroupEntry { binding: binding.binding, resource });
        }
        let descriptor = wgpu::BindGroupDescriptor { label: None, layout: &self.bindings, entries: &entries };
        Ok(link.device.create_bind_group(&descriptor))
    }
}

fn layout_entry(binding: &Binding) -> wgpu::BindGroupLayoutEntry {
    let ty = match binding.kind {
        Access::Uniform => wgpu::BufferBindingType::Uniform,
        kind => wgpu::BufferBindingType::Storage { read_only: kind == Access::Read },
    };
    wgpu::BindGroupLayoutEntry {
        binding: binding.binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    }
}

#[cfg(test)]
mod tests {
    use super::fold;

    #[test]
    fn folded_dispatches_cover_all_and_stay_within_the_limit() {
        for groups in [0, 1, 65535, 65536, 131_071, 1_000_000, 4_000_000_000] {
            let (x, y) = fold(groups, 65535);
            assert!(x <= 65535 && y <= 65535 && u64::from(x) * u64::from(y) >= u64::from(groups), "{groups}");
            assert!(u64::from(x) * u64::from(y) < u64::from(groups.max(1)) + u64::from(y), "{groups}");
        }
    }
}
