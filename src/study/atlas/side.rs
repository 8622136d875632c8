//! One of the two runs of a row.

use super::outcome::{self, Outcome};
use crate::backend::cpu::Cpu;
use crate::backend::{Backend, Choice};
use crate::run::{self, Options, Stop};
use crate::scene::Scene;
use crate::tensor::{Line, Plane, Solid};
use std::path::Path;

/// The text of a scene, kept in the program, and its path in the repository.
#[derive(Debug, Clone, Copy)]
pub struct Text {
    pub path: &'static str,
    pub text: &'static str,
}

/// A [`Text`] by its path in the repository.
macro_rules! text {
    ($path:literal) => {
        $crate::study::atlas::Text { path: $path, text: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/", $path)) }
    };
}
pub(super) use text;

/// The arithmetic of a run, always on the CPU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Machine {
    Double,
    Single,
    /// In f32 as codes commonly have it: what a sum drops is lost.
    SingleBare,
}

/// How long a run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    Full,
    /// As short as a test needs it.
    Test,
}

/// A method and the scene that it runs.
#[derive(Debug)]
pub struct Side {
    /// What the method is, in a few words.
    pub method: &'static str,
    pub scene: Text,
    pub variant: Option<&'static str>,
    /// Overrides.
    pub changes: fn() -> Vec<String>,
    pub machine: Machine,
}

/// Overrides as they are typed.
pub fn set(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_string()).collect()
}

/// Two pictures abreast fit a page.
const PICTURE: [&str; 2] = ["output.picture.width=640", "output.picture.height=480"];

/// A run that goes wrong leaves the picture before.
const FRAMES: f64 = 10.0;

impl Side {
    /// The scene as it is, in f64.
    pub const fn new(method: &'static str, scene: Text) -> Self {
        Self { method, scene, variant: None, changes: Vec::new, machine: Machine::Double }
    }

    pub const fn variant(self, variant: &'static str) -> Self {
        Self { variant: Some(variant), ..self }
    }

    pub const fn changes(self, changes: fn() -> Vec<String>) -> Self {
        Self { changes, ..self }
    }

    pub const fn machine(self, machine: Machine) -> Self {
        Self { machine, ..self }
    }

    /// # Errors
    /// One sentence where the scene refuses its changes.
    pub fn scene(&self, size: Size, small: &[&str]) -> Result<Scene, String> {
        let name = Path::new(self.scene.path).file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy());
        let small = if size == Size::Test { small } else { &[] };
        let mut overrides = [(self.changes)(), set(small), set(&PICTURE)].concat();
        let parse = |overrides: &[String]| Scene::parse(self.scene.text, &name, self.variant, overrides);
        if !overrides.iter().any(|change| change.starts_with("output.frames=")) {
            overrides.push(format!("output.frames={:?}", parse(&overrides)?.file.duration / FRAMES));
        }
        parse(&overrides)
    }

    /// Runs into a folder; a run that goes wrong has an outcome too.
    ///
    /// # Errors
    /// A refused scene, a file that cannot be written, or the user.
    pub fn run(&self, folder: &Path, size: Size, small: &[&str]) -> Result<Outcome, Stop> {
        let scene = self.scene(size, small).map_err(Stop::Refused)?;
        let options = Options {
            choice: Choice::Cpu,
            out: Some(folder.into()),
            dry: false,
            force: true,
            quiet: true,
            energy: Options::UNWATCHED,
            ..Options::default()
        };
        let stopped = match run::run_on(&scene, &options, self.machine.open(&scene)) {
            Ok(_) => None,
            Err(Stop::Failed(why)) => Some(why),
            Err(stop) => return Err(stop),
        };
        outcome::mark(folder, stopped.as_deref()).and_then(|()| Outcome::read(scene, folder)).map_err(Stop::Failed)
    }

    /// The command that makes the same run.
    pub fn command(&self) -> String {
        let mut words = format!("lithosph run {}", self.scene.path);
        if let Some(variant) = self.variant {
            words += &format!(" --variant {variant}");
        }
        for change in (self.changes)() {
            words += &format!(" --set '{change}'");
        }
        words
            + match self.machine {
                Machine::Double => " --backend cpu",
                Machine::Single => " --backend cpu --precision f32",
                Machine::SingleBare => " --backend cpu --precision f32   (here with sums that are not compensated)",
            }
    }
}

impl Machine {
    fn open(self, scene: &Scene) -> Box<dyn Backend> {
        match (scene.dimension(), self) {
            (1, Self::Double) => Box::new(Cpu::new(scene.state::<Line<f64>>(false))),
            (2, Self::Double) => Box::new(Cpu::new(scene.state::<Plane<f64>>(false))),
            (_, Self::Double) => Box::new(Cpu::new(scene.state::<Solid<f64>>(false))),
            (1, _) => Box::new(Cpu::new(scene.state::<Line<f32>>(self == Self::Single))),
            (2, _) => Box::new(Cpu::new(scene.state::<Plane<f32>>(self == Self::Single))),
            (_, _) => Box::new(Cpu::new(scene.state::<Solid<f32>>(self == Self::Single))),
        }
    }
}
