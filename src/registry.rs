//! What a run can be composed of, as a value: shader library, kernels, potentials, laws, fields and passes.
//!
//! A run takes from [`Registry::full`] the parts that its method names. Tests show that it pays for nothing else by taking
//! everything else away: [`Registry::own`] holds only the parts that one method names, none of which it could do without, and
//! composes the same texts, byte for byte.

use crate::backend::shader;
use crate::contact::Potential;
use crate::fields::Field;
use crate::material::Law;
use crate::method::Method;
use crate::pass::Pass;
use crate::smoothing::Smoothing;
use crate::step;
use std::fmt::Write as _;
use std::sync::LazyLock;

/// A file of the shader library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct File {
    pub folder: &'static str,
    /// What `#import` names.
    pub stem: &'static str,
    pub text: &'static str,
}

/// One thing that a run may be composed of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    File(File),
    Smoothing(Smoothing),
    Potential(Potential),
    Law(Law),
    Field(Field),
    Pass(Pass),
}

/// Parts in the order of their lists.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Registry {
    pub parts: Vec<Part>,
}

/// A method composed: all that its run allocates, dispatches and compiles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texts {
    /// A line for each field.
    pub fields: String,
    /// A line for each dispatch, by the stage of a run that it belongs to.
    pub dispatches: String,
    /// WGSL of each pass, in order of first use.
    pub shaders: String,
}

static FULL: LazyLock<Registry> = LazyLock::new(|| {
    let files = shader::LIBRARY.iter().copied().map(Part::File);
    let numerics = Smoothing::ALL.iter().copied().map(Part::Smoothing);
    let physics = Potential::ALL.iter().copied().map(Part::Potential).chain(Law::ALL.iter().copied().map(Part::Law));
    let columns = Field::ALL.iter().copied().map(Part::Field);
    let passes = Pass::ALL.iter().copied().map(Part::Pass);
    Registry { parts: files.chain(numerics).chain(physics).chain(columns).chain(passes).collect() }
});

impl Registry {
    /// Everything that there is.
    pub fn full() -> &'static Self {
        &FULL
    }

    /// What one method names: its laws, its kernel, its potentials, the fields and passes of its steps, and the files
    /// that these import.
    ///
    /// # Errors
    /// The first thing that there is not.
    pub fn own(method: &Method) -> Result<Self, String> {
        let passes = step::passes(method);
        let mut stems = Vec::new();
        for &pass in &passes {
            stems.extend(shader::compose_from(&FULL, pass, method)?.imports);
        }
        let fields = FULL.fields(method)?;
        let belongs = |part: &Part| match part {
            Part::File(file) => stems.iter().any(|stem| stem == file.stem),
            Part::Smoothing(smoothing) => *smoothing == method.smoothing,
            Part::Potential(potential) => method.contact.potentials.contains(potential),
            Part::Law(law) => method.laws.contains(law),
            Part::Field(field) => fields.contains(field),
            Part::Pass(pass) => passes.contains(pass),
        };
        Ok(Self { parts: FULL.parts.iter().copied().filter(belongs).collect() })
    }

    /// A file of the library.
    pub fn file(&self, stem: &str) -> Option<File> {
        self.parts.iter().find_map(|part| match part {
            Part::File(file) if file.stem == stem => Some(*file),
            _ => None,
        })
    }

    /// A law by its word.
    pub fn law(&self, word: &str) -> Option<Law> {
        self.parts.iter().find_map(|part| match part {
            Part::Law(law) if law.word() == word => Some(*law),
            _ => None,
        })
    }

    /// Fields that the method's passes read or write.
    ///
    /// # Errors
    /// The first that this registry lacks.
    pub fn fields(&self, method: &Method) -> Result<Vec<Field>, String> {
        let needed = step::fields(method);
        for &field in &needed {
            self.holds(Part::Field(field), "field", field.name())?;
        }
        let field = |part: &Part| match part {
            Part::Field(field) if needed.contains(field) => Some(*field),
            _ => None,
        };
        Ok(self.parts.iter().filter_map(field).collect())
    }

    /// Whether all that the method names beside fields, passes and files is here.
    ///
    /// # Errors
    /// The first thing that is not.
    pub fn check(&self, method: &Method) -> Result<(), String> {
        self.holds(Part::Smoothing(method.smoothing), "kernel", method.smoothing.word())?;
        for &potential in &method.contact.potentials {
            self.holds(Part::Potential(potential), "potential", potential.name())?;
        }
        method.laws.iter().try_for_each(|&law| self.holds(Part::Law(law), "law", law.word()))
    }

    /// # Errors
    /// Where the pass is not here.
    pub fn check_pass(&self, pass: Pass) -> Result<(), String> {
        self.holds(Part::Pass(pass), "pass", pass.name())
    }

    fn holds(&self, part: Part, kind: &str, name: &str) -> Result<(), String> {
        if self.parts.contains(&part) { Ok(()) } else { Err(format!("the registry has no {kind} `{name}`")) }
    }

    /// Composes a method from this registry.
    ///
    /// # Errors
    /// The first thing that the method names and the registry lacks.
    pub fn texts(&self, method: &Method) -> Result<Texts, String> {
        self.check(method)?;
        let mut fields = String::new();
        for field in self.fields(method)? {
            let _ = writeln!(fields, "{}: {} x {:?}", field.name(), field.kind().words_in(method.dimension), field.set());
        }
        let mut dispatches = String::new();
        for (stage, call) in step::calls(method) {
            self.check_pass(call.pass)?;
            for entry in call.pass.entries() {
                let (pass, entry, domain) = (call.pass.name(), entry.name, entry.domain);
                let _ = writeln!(dispatches, "{stage}: {pass}.{entry} over {domain:?} {:?}", call.stage.constants());
            }
        }
        let mut shaders = String::new();
        for pass in step::passes(method) {
            shaders += &format!("// {}\n{}", pass.name(), shader::compose_from(self, pass, method)?.text);
        }
        Ok(Texts { fields, dispatches, shaders })
    }
}

#[cfg(test)]
mod tests;
