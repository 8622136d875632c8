//! Shader text for one method, and the bindings and constants that naga reads out of it.
//!
//! Sources are WGSL with four directives, each on a line of its own:
//! `#import name` puts `shaders/lib/name.wgsl` (or `material/name.wgsl`) there once (`tensor`, `smoothing`,
//! `potential` and `laws` are chosen by the method); `#if flag`, `#if !flag`, `#else`, `#endif` keep or drop lines by
//! [`Method::flags`].
//! `#import name if flag` (or `if !flag`) imports where the flag holds. `#import name KEY=word` puts the file there with each
//! KEY of its text replaced, each time anew, since the words differ; an `if` may follow.
//! A pass with one invocation for each of its rows defines `of_particle`, `of_facet` or `of_cell`; the entry point that
//! calls it is made from the pass's declaration. `@binding(_)` is numbered in order of appearance, so bindings are written in WGSL only, and buffers
//! are bound by the variables' names, which [`Shader::entry`] tells.

mod contacts;
mod laws;

use crate::contact::Potential;
use crate::material::Law;
use crate::method::{FLAGS, Method};
use crate::pass::Pass;
use crate::registry::{File, Registry};
use naga::valid::{Capabilities, GlobalUse, ModuleInfo, ValidationFlags, Validator};

macro_rules! library {
    ($($folder:ident: $($stem:ident),*;)*) => {
        /// The files that `#import` finds.
        pub const LIBRARY: &[File] = &[$($(File {
            folder: stringify!($folder),
            stem: stringify!($stem),
            text: include_str!(concat!("../../shaders/", stringify!($folder), "/", stringify!($stem), ".wgsl")),
        }),*),*];
    };
}

library! {
    lib: acceleration, adjoint_stress, artificial_stress, body, body_index, body_options, bond, cell, compensated,
        constraint, contact_pair, coupling, course, course_integral, density, descent, deviatoric_rate,
        displacement_difference, facet, facet_lever, facet_pair, facet_touched, finite_return, flow, half_kick,
        hourglass_stiffness, inelastic, integrated, integrated_stress, inverse, invocation, kernel, largest, linear_gradient, mass,
        memory, mirror, moving_velocity, obstacle, of_roles, own_neighbor, pair, pair_velocity, params, plain_stress,
        quadratic_gradient, radial_return, real, relaxation, separation, shape, shape_columns, shape_node, stick, stiffness,
        strain,
        temperature, tensor_1d, tensor_2d, tensor_3d, unbalanced, viscosity, visit_cells, volume, volumetric_stress,
        yielding;
    contact: zones;
}

/// What decides the text of a shader.
#[derive(Debug, Clone, Copy)]
pub struct Choice<'a> {
    pub flags: &'a [&'a str],
    pub dimension: usize,
    /// Text for `#import smoothing`.
    pub smoothing: &'a str,
    /// What `#import potential` chooses from, in order of their numbers.
    pub potentials: &'a [Potential],
    /// What `#import laws` chooses from, in order of their numbers.
    pub laws: &'a [Law],
}

/// The WGSL of a pass for a method.
///
/// # Panics
/// If a shader of this crate names an unknown flag, import or directive.
pub fn compose(pass: Pass, method: &Method) -> String {
    compose_from(Registry::full(), pass, method).unwrap_or_else(|wrong| panic!("{wrong}")).text
}

/// A composed shader.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Composed {
    pub text: String,
    /// What was imported, each once, in order of first use; `tensor` by the stem of its file.
    pub imports: Vec<String>,
}

/// The WGSL of a pass from what a registry holds.
///
/// # Errors
/// One sentence on what the registry lacks, or the place where a shader names an unknown flag, import or directive.
pub fn compose_from(registry: &Registry, pass: Pass, method: &Method) -> Result<Composed, String> {
    registry.check(method)?;
    registry.check_pass(pass)?;
    let choice = Choice {
        flags: &method.flags(),
        dimension: method.dimension,
        smoothing: method.smoothing.source(),
        laws: &method.laws,
        potentials: &method.contact.potentials,
    };
    composed(registry, pass.name(), pass.source(), pass.declaration().entry(), &choice)
}

/// [`compose`] for any text; `name` stands for the file in messages.
///
/// # Panics
/// As [`compose`].
pub fn compose_text(name: &str, source: &str, choice: &Choice) -> String {
    composed(Registry::full(), name, source, None, choice).unwrap_or_else(|wrong| panic!("{wrong}")).text
}

/// `entry` is what is added to the source, which then need not import what an entry point takes.
fn composed(registry: &Registry, name: &str, source: &str, entry: Option<String>, choice: &Choice) -> Result<Composed, String> {
    if let Some(flag) = choice.flags.iter().find(|flag| !is_flag(flag)) {
        return Err(format!("flag {flag} is missing from the list of flags in src/method.rs"));
    }
    let mut composer = Composer { registry, choice, imported: Vec::new(), text: String::new() };
    if entry.is_some() {
        composer.add(name, "#import invocation")?;
    }
    composer.add(name, source)?;
    composer.text.push_str(entry.as_deref().unwrap_or_default());
    Ok(Composed { text: number_bindings(&composer.text), imports: composer.imported })
}

/// Whether shaders may ask for a word.
fn is_flag(word: &str) -> bool {
    FLAGS.iter().any(|(flag, _)| *flag == word)
}

struct Composer<'a> {
    registry: &'a Registry,
    choice: &'a Choice<'a>,
    imported: Vec<String>,
    text: String,
}

impl Composer<'_> {
    /// Whether `flag` or `!flag` holds for the method; None for an unknown flag.
    fn holds(&self, flag: &str) -> Option<bool> {
        let (word, wanted) = flag.strip_prefix('!').map_or((flag, true), |word| (word, false));
        is_flag(word).then(|| self.choice.flags.contains(&word) == wanted)
    }

    /// Keys and words that follow an import's name; None where a flag that it asks for does not hold.
    fn values<'t>(&self, how: &[&'t str]) -> Result<Option<Vec<(&'t str, &'t str)>>, &'static str> {
        let (values, holds) = match how {
            [values @ .., "if", flag] => (values, self.holds(flag).ok_or("unknown flag")?),
            values => (values, true),
        };
        let values: Option<Vec<_>> = values.iter().map(|value| value.split_once('=')).collect();
        values.map(|values| holds.then_some(values)).ok_or("a word of an import has no key")
    }

    fn add(&mut self, name: &str, source: &str) -> Result<(), String> {
        // For each open `#if`: whether its present branch is kept.
        let mut open: Vec<bool> = Vec::new();
        for (k, line) in source.lines().enumerate() {
            let wrong = |what: &str| Err(format!("{name}.wgsl line {}: {what}: {line}", k + 1));
            let kept = open.iter().all(|&branch| branch);
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                ["#if", flag] => match self.holds(flag) {
                    Some(holds) => open.push(holds),
                    None => return wrong("unknown flag"),
                },
                ["#import", import, ref how @ ..] => match self.values(how) {
                    Err(what) => return wrong(what),
                    Ok(Some(values)) if kept => match self.find(import) {
                        Some((stem, text)) => self.import(stem, text, &values)?,
                        None => return wrong("unknown import"),
                    },
                    Ok(_) => {}
                },
                ["#else"] => match open.last_mut() {
                    Some(branch) => *branch = !*branch,
                    None => return wrong("no open #if"),
                },
                ["#endif"] if open.pop().is_none() => return wrong("no open #if"),
                ["#endif"] => {}
                [word, ..] if word.starts_with('#') => return wrong("unknown directive"),
                _ if kept => {
                    self.text.push_str(line);
                    self.text.push('\n');
                }
                _ => {}
            }
        }
        if open.is_empty() { Ok(()) } else { Err(format!("{name}.wgsl: an #if is not closed")) }
    }

    /// Stem and text of what an import names.
    fn find(&self, import: &str) -> Option<(String, String)> {
        let stem = match import {
            "smoothing" => return Some((import.into(), self.choice.smoothing.to_string())),
            "potential" => return Some((import.into(), contacts::text(self.choice.potentials))),
            "laws" => return Some((import.into(), laws::text(self.choice.laws))),
            "stiffening" => return Some((import.into(), laws::stiffening(self.choice.laws))),
            "pressures" | "strengths" | "heats" => return Some((import.into(), laws::over_role(import, self.choice.laws)?)),
            "tensor" => format!("tensor_{}d", self.choice.dimension),
            _ => import.to_string(),
        };
        if let Some(law) = self.registry.law(&stem) {
            return Some((stem, laws::text_of(law)));
        }
        let file = self.registry.file(&stem)?;
        Some((stem, file.text.to_string()))
    }

    /// Adds a file once, or each time with its keys replaced.
    fn import(&mut self, stem: String, mut text: String, values: &[(&str, &str)]) -> Result<(), String> {
        let known = self.imported.contains(&stem);
        if known && values.is_empty() {
            return Ok(());
        }
        if !known {
            self.imported.push(stem.clone());
        }
        for (key, word) in values {
            text = text.replace(key, word);
        }
        self.add(&stem, &text)
    }
}

fn number_bindings(text: &str) -> String {
    let mut parts = text.split("@binding(_)");
    let mut numbered = parts.next().unwrap_or_default().to_string();
    for (number, part) in parts.enumerate() {
        numbered.push_str(&format!("@binding({number})"));
        numbered.push_str(part);
    }
    numbered
}

/// How a shader uses a buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    Uniform,
    Read,
    ReadWrite,
}

/// A buffer that an entry point uses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Binding {
    pub group: u32,
    pub binding: u32,
    pub name: String,
    pub kind: Access,
    /// Whether the entry point loads from it, and stores to it.
    pub reads: bool,
    pub writes: bool,
}

/// What the host must know of an entry point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interface {
    /// Only what this entry point uses, in order of binding.
    pub bindings: Vec<Binding>,
    /// Invocations in a workgroup.
    pub workgroup: u32,
    /// Names of the `override` constants of the whole shader.
    pub overrides: Vec<String>,
}

/// Parsed and validated WGSL.
pub struct Shader {
    module: naga::Module,
    info: ModuleInfo,
}

impl Shader {
    /// The error shows the place in the composed text.
    pub fn parse(wgsl: &str) -> Result<Self, String> {
        let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(&module)
            .map_err(|error| error.emit_to_string(wgsl))?;
        Ok(Self { module, info })
    }

    pub fn entry(&self, name: &str) -> Result<Interface, String> {
        let entries = &self.module.entry_points;
        let index =
            entries.iter().position(|entry| entry.name == name).ok_or_else(|| format!("the shader has no entry point {name}"))?;
        if entries[index].workgroup_size_overrides.is_some() {
            return Err(format!("the workgroup size of {name} must be a number"));
        }
        let usage = self.info.get_entry_point(index);
        let mut bindings: Vec<Binding> = (self.module.global_variables.iter())
            .filter(|(handle, _)| !usage[*handle].is_empty())
            .filter_map(|(handle, variable)| binding_of(variable, usage[handle]))
            .collect();
        bindings.sort_by_key(|binding| (binding.group, binding.binding));
        Ok(Interface {
            bindings,
            workgroup: entries[index].workgroup_size.iter().product(),
            overrides: self.module.overrides.iter().filter_map(|(_, constant)| constant.name.clone()).collect(),
        })
    }
}

/// Name and offset of each member of a structure, so that a test can hold the host's twin against it.
pub fn offsets(wgsl: &str, structure: &str) -> Result<Vec<(String, u32)>, String> {
    let shader = Shader::parse(wgsl)?;
    let named = |(_, ty): (_, &naga::Type)| match &ty.inner {
        naga::TypeInner::Struct { members, .. } if ty.name.as_deref() == Some(structure) => {
            Some(members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect())
        }
        _ => None,
    };
    shader.module.types.iter().find_map(named).ok_or_else(|| format!("the shader has no structure {structure}"))
}

fn binding_of(variable: &naga::GlobalVariable, used: GlobalUse) -> Option<Binding> {
    let place = variable.binding.as_ref()?;
    let kind = match variable.space {
        naga::AddressSpace::Uniform => Access::Uniform,
        naga::AddressSpace::Storage { access } if access.contains(naga::StorageAccess::STORE) => Access::ReadWrite,
        naga::AddressSpace::Storage { .. } => Access::Read,
        _ => return None,
    };
    let (reads, writes) = (used.contains(GlobalUse::READ), used.contains(GlobalUse::WRITE));
    Some(Binding { group: place.group, binding: place.binding, name: variable.name.clone()?, kind, reads, writes })
}

/// Bindings, workgroup size and constants of an entry point.
pub fn reflect(wgsl: &str, entry: &str) -> Result<Interface, String> {
    Shader::parse(wgsl)?.entry(entry)
}

/// Whether naga takes the text.
pub fn validate(wgsl: &str) -> Result<(), String> {
    Shader::parse(wgsl).map(|_| ())
}

#[cfg(test)]
mod tests;
