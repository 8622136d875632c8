//! What each scene pays for: fields, passes, dispatches, shader text, bytes a particle and time a step, a row each.
//!
//! A row also tells whether the scene is composed the same, byte for byte, by a registry that holds its own laws,
//! kernel, files, fields and passes alone ([`Registry::own`]): what other scenes name costs it nothing.

mod measure;
mod page;
mod report;

pub use measure::Step;

use crate::backend::Choice;
use crate::method::{Formulation, Method};
use crate::registry::{Registry, Texts};
use crate::run::{INTERRUPTED, Stop};
use crate::scene::Scene;
use crate::step;
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
    pub formulation: &'static str,
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
    let (own, full) = composed(&scene.method).map_err(Stop::Failed)?;
    if own != full {
        return Err(Stop::Failed(format!("{}: its own parts compose another run than the full registry does", scene.label())));
    }
    Ok(format!("# fields\n{}\n# dispatches\n{}\n# shaders\n{}", own.fields, own.dispatches, own.shaders))
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
    let method = &scene.method;
    let particles = scene.particles.len();
    let (own, full) = composed(method).map_err(Stop::Failed)?;
    let each = |word: usize| scene.state_bytes(word, word == 4) as f64 / particles as f64;
    let stepped = request.all || particles <= MANY;
    Ok(Row {
        scene: scene.label(),
        dimension: method.dimension,
        formulation: match method.formulation {
            Formulation::Eulerian => "eulerian",
            Formulation::TotalLagrangian => "total_lagrangian",
            Formulation::CorrectedKernel => "corrected_kernel",
        },
        particles,
        fields: step::fields(method).iter().map(|field| field.name()).collect(),
        passes: step::passes(method).iter().map(|pass| pass.name()).collect(),
        dispatches: step::step(method).iter().map(|call| call.pass.entries().len()).sum(),
        shader_bytes: full.shaders.len(),
        own_parts_suffice: own == full,
        bytes: [each(4), each(8)],
        step: stepped.then(|| measure::step(scene, &request.choice)).transpose()?,
    })
}
