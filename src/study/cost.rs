//! What each scene pays for: fields, passes, dispatches, shader text, bytes a particle and time a step, a row each.
//!
//! A row also tells whether the scene is composed the same, byte for byte, by a registry that holds its own laws,
//! kernel, files, fields and passes alone ([`Registry::own`]): what other scenes name costs it nothing.

mod measure;
mod page;
mod report;

pub use measure::Step;

use crate::backend::Choice;
use crate::method::Method;
use crate::registry::{Registry, Texts};
use crate::run::{INTERRUPTED, Stop};
use crate::scene::Scene;
use crate::step;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// Particles beyond which a scene is not stepped unless asked for.
pub const MANY: usize = 300_000;

/// What the command line asks for.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// All of the folder `scenes` where none is named.
    pub scenes: Vec<PathBuf>,
    pub variant: Option<String>,
    pub set: Vec<String>,
    pub choice: Choice,
    /// Steps scenes of any size.
    pub all: bool,
    /// The CSV; `out/study/cost.csv` unless given.
    pub out: Option<PathBuf>,
}

/// A scene's row.
#[derive(Debug, Clone)]
pub struct Row {
    pub scene: String,
    pub dimension: usize,
    pub formulation: String,
    pub particles: usize,
    pub fields: Vec<&'static str>,
    pub passes: Vec<&'static str>,
    /// Entry points run in one step.
    pub dispatches: usize,
    /// Bytes of WGSL of all passes.
    pub shader_bytes: usize,
    /// Composed the same from its own parts alone.
    pub own_parts_suffice: bool,
    /// Bytes a particle of all tables in f32 and in f64, without the distinct bonds that a CPU may keep.
    pub bytes: [f64; 2],
    /// `None` where the scene was not stepped.
    pub step: Option<Step>,
}

/// Measures each scene, and tells of each row; writes the table, gives its text and whether specialisation holds.
///
/// # Errors
/// A scene that is refused, a backend or file that cannot be had, or the user.
pub fn run(request: &Request, mut tell: impl FnMut(&Row)) -> Result<(String, bool), Stop> {
    let files = if request.scenes.is_empty() { all_scenes().map_err(Stop::Refused)? } else { request.scenes.clone() };
    let mut rows = Vec::new();
    for file in files {
        if INTERRUPTED.load(Ordering::Relaxed) {
            return Err(Stop::Interrupted(format!("interrupted after {} scenes: nothing was written", rows.len())));
        }
        let scene = Scene::open(&file, request.variant.as_deref(), &request.set).map_err(Stop::Refused)?;
        let row = row(&scene, request)?;
        tell(&row);
        rows.push(row);
    }
    let path = request.out.clone().unwrap_or_else(|| "out/study/cost.csv".into());
    report::write(&path, &rows, &request.choice).map_err(Stop::Failed)?;
    page::write(&path, &rows).map_err(Stop::Failed)?;
    let holds = rows.iter().all(|row| row.own_parts_suffice);
    Ok((format!("{}written to {}", report::text(&rows), path.display()), holds))
}

/// Fields, dispatches and shaders of one scene, as composed from its own parts alone.
///
/// # Errors
/// A scene that is refused, or one that is composed otherwise by the full registry.
pub fn show(path: &Path, variant: Option<&str>, set: &[String]) -> Result<String, Stop> {
    let scene = Scene::open(path, variant, set).map_err(Stop::Refused)?;
    let mut text = String::new();
    for member in scene.members() {
        let (own, full) = composed(&member.method).map_err(Stop::Failed)?;
        if own != full {
            return Err(Stop::Failed(format!(
                "{}: its own parts compose another run than the full registry does",
                scene.label()
            )));
        }
        if !scene.parts.is_empty() {
            text += &format!("# {}\n", heading(member));
        }
        text += &format!("# fields\n{}\n# dispatches\n{}\n# shaders\n{}", own.fields, own.dispatches, own.shaders);
    }
    Ok(text)
}

/// What a member of a run of several groups is.
fn heading(member: &Scene) -> String {
    if member.method.between {
        return "between the groups".into();
    }
    let names: Vec<&str> = member.bodies.iter().map(|body| body.name.as_str()).collect();
    format!("group of {} ({})", names.join(", "), member.method.formulation.word())
}

/// From the parts that the method names, and from all that there are.
fn composed(method: &Method) -> Result<(Texts, Texts), String> {
    Ok((Registry::own(method)?.texts(method)?, Registry::full().texts(method)?))
}

fn all_scenes() -> Result<Vec<PathBuf>, String> {
    let failed = |error| format!("scenes: {error}; name scenes, or start where the folder `scenes` lies");
    let entries = std::fs::read_dir("scenes").map_err(failed)?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    if files.is_empty() { Err("scenes: the folder holds no scene".into()) } else { Ok(files) }
}

fn row(scene: &Scene, request: &Request) -> Result<Row, Stop> {
    let particles = scene.particles.len();
    let methods = scene.methods();
    let composed: Vec<(Texts, Texts)> = methods.iter().map(composed).collect::<Result<_, _>>().map_err(Stop::Failed)?;
    let each = |word: usize| scene.run_bytes(word, word == 4) as f64 / particles as f64;
    let stepped = request.all || particles <= MANY;
    let words: BTreeSet<&str> = scene.groups().iter().map(|group| group.method.formulation.word()).collect();
    Ok(Row {
        scene: scene.label(),
        dimension: scene.dimension(),
        formulation: words.into_iter().collect::<Vec<_>>().join(" + "),
        particles,
        fields: scene.fields().iter().map(|field| field.name()).collect(),
        passes: step::passes_of(&methods).iter().map(|pass| pass.name()).collect(),
        dispatches: methods.iter().flat_map(step::step).map(|call| call.pass.entries().len()).sum(),
        shader_bytes: composed.iter().map(|(_, full)| full.shaders.len()).sum(),
        own_parts_suffice: composed.iter().all(|(own, full)| own == full),
        bytes: [each(4), each(8)],
        step: stepped.then(|| measure::step(scene, &request.choice)).transpose()?,
    })
}
