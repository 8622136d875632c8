//! Command line: words, and the table of commands.

mod check;
mod say;
mod signals;
mod study;

use crate::backend::Choice;
use crate::complain::complain;
use crate::run::{Finished, INTERRUPTED, Options, Stop};
use crate::scene::Scene;
use crate::scene::file::EnergyWatch;
use crate::{contact, fields, material, observable, pass, run, scene, smoothing};
use clap::{Args, Parser, Subcommand, ValueEnum};
use say::say;
use std::path::{Path, PathBuf};

/// Solids by smoothed particle hydrodynamics, on any GPU.
#[derive(Debug, Parser)]
#[command(name = "lithosph", version)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a scene and write series, particles and pictures.
    Run(RunArgs),
    /// Run scenes and compare them with what they expect; exit code 0 only if all holds.
    Check(check::Arguments),
    /// Paint stored particle states.
    Render(RenderArgs),
    /// List kernels, laws, passes, fields, observables; or the variants of a scene.
    List { scene: Option<PathBuf> },
    /// List the adapters that a run can use.
    Devices,
    /// Sweep settings over a scene.
    #[command(subcommand)]
    Study(study::Study),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BackendWord {
    /// The best hardware adapter, else the CPU.
    Auto,
    /// Any adapter, a software one too.
    Gpu,
    Cpu,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PrecisionWord {
    F32,
    F64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum EnergyWord {
    /// Warn at 1 % of drift, stop where the scene says, or at 10 %.
    Stop,
    /// Warn and go on.
    Warn,
    /// Sum no energies.
    Off,
}

impl EnergyWord {
    fn watch(self) -> EnergyWatch {
        match self {
            Self::Stop => EnergyWatch::Stop,
            Self::Warn => EnergyWatch::Warn,
            Self::Off => EnergyWatch::Off,
        }
    }
}

#[derive(Debug, Args)]
struct Where {
    #[arg(long, value_enum, default_value = "auto")]
    backend: BackendWord,
    /// Part of an adapter's name, as `lithosph devices` prints it.
    #[arg(long)]
    adapter: Option<String>,
    /// Precision of the CPU path, f64 unless given; a GPU steps in f32.
    #[arg(long, value_enum)]
    precision: Option<PrecisionWord>,
    /// Threads of the CPU path; all cores unless given.
    #[arg(long)]
    threads: Option<usize>,
    /// No progress bar and no summary.
    #[arg(long, short)]
    quiet: bool,
}

impl Where {
    fn choice(&self) -> Result<Choice, Stop> {
        Ok(match (self.backend, self.precision) {
            (BackendWord::Cpu, _) if self.adapter.is_some() => {
                return Err(Stop::Refused("--adapter names a graphics adapter, and --backend cpu takes none".into()));
            }
            (BackendWord::Auto | BackendWord::Gpu, Some(_)) => {
                return Err(Stop::Refused("--precision is that of the CPU path: it goes with --backend cpu".into()));
            }
            (BackendWord::Auto, _) if self.adapter.is_none() => Choice::Auto,
            (BackendWord::Cpu, Some(PrecisionWord::F32)) => Choice::Cpu32,
            (BackendWord::Cpu, _) => Choice::Cpu,
            _ => Choice::Gpu(self.adapter.clone()),
        })
    }

    fn set_threads(&self) -> Result<(), Stop> {
        let Some(threads) = self.threads else { return Ok(()) };
        let built = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        built.map_err(|e| Stop::Refused(format!("--threads {threads}: {e}")))
    }
}

#[derive(Debug, Args)]
struct RunArgs {
    #[arg(required_unless_present = "resume")]
    scene: Option<PathBuf>,
    #[arg(long)]
    variant: Option<String>,
    /// Override a value: `--set formulation.viscosity.alpha=0.5`. May be given several times.
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Output folder; out/SCENE[-VARIANT] unless given.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Overwrite an output folder.
    #[arg(long)]
    force: bool,
    /// Go on from the checkpoint in this output folder.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["scene", "variant", "set", "out", "force"])]
    resume: Option<PathBuf>,
    /// When the energy drifts, in place of the scene's `watch.energy`.
    #[arg(long, value_enum, value_name = "WORD")]
    energy: Option<EnergyWord>,
    #[command(flatten)]
    place: Where,
}

#[derive(Debug, Args)]
struct RenderArgs {
    /// A particles.vtkhdf, or the folder that holds one.
    file: PathBuf,
    /// Field by path: pressure, velocity.magnitude, stress.von_mises, stress.yy …
    #[arg(long)]
    field: Option<String>,
    /// Colour range.
    #[arg(long, num_args = 2, value_names = ["LOW", "HIGH"], allow_negative_numbers = true)]
    range: Option<Vec<f64>>,
    /// Only this stored step, counted from 0; all unless given.
    #[arg(long)]
    step: Option<usize>,
    #[arg(long, default_value_t = 1200)]
    width: u32,
    #[arg(long, default_value_t = 900)]
    height: u32,
    /// Direction from which a 3D scene is seen.
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], allow_negative_numbers = true)]
    eye: Option<Vec<f64>>,
    /// Folder for the pictures; `frames-FIELD` beside the file unless given.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Overwrite pictures.
    #[arg(long)]
    force: bool,
    /// Paint on the GPU even if it is a software one.
    #[arg(long)]
    gpu: bool,
}

/// Does what the command line says; gives the exit code.
pub fn main() -> i32 {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let _ = error.print();
            return if error.use_stderr() { 2 } else { 0 };
        }
    };
    if let Err(error) = signals::listen(&INTERRUPTED) {
        complain(&format!("lithosph: cannot listen for interrupts: {error}"));
    }
    let result = match cli.command {
        Command::Run(args) => run_scene(&args),
        Command::Check(args) => check::check(&args),
        Command::Render(args) => render(&args),
        Command::List { scene } => list(scene.as_deref()),
        Command::Devices => devices(),
        Command::Study(what) => study::study(&what),
    };
    match result {
        Ok(code) => code,
        Err(stop) => {
            let (code, message) = match stop {
                Stop::Refused(message) => (2, message),
                Stop::Failed(message) => (1, message),
                Stop::Interrupted(message) => (130, message),
            };
            complain(&format!("lithosph: {message}"));
            code
        }
    }
}

fn run_scene(args: &RunArgs) -> Result<i32, Stop> {
    args.place.set_threads()?;
    let (choice, out) = (args.place.choice()?, args.out.clone());
    let options = Options {
        choice,
        out,
        dry: false,
        force: args.force,
        quiet: args.place.quiet,
        energy: args.energy.map(EnergyWord::watch),
        ..Options::default()
    };
    let finished = match (&args.resume, &args.scene) {
        (Some(folder), _) => {
            let scene = Scene::open(&folder.join("run.toml"), None, &[]).map_err(Stop::Refused)?;
            match run::resume(&scene, &options, folder.clone())? {
                Some(finished) => finished,
                None => {
                    say(&format!("{}: the run is finished, there is nothing to go on with", folder.display()));
                    return Ok(0);
                }
            }
        }
        (None, Some(path)) => {
            let scene = Scene::open(path, args.variant.as_deref(), &args.set).map_err(Stop::Refused)?;
            announce(&scene, &options);
            run::run(&scene, &options)?
        }
        (None, None) => return Err(Stop::Refused("run needs a scene, or --resume with a folder".into())),
    };
    if !args.place.quiet {
        tell(&finished);
    }
    Ok(0)
}

fn announce(scene: &Scene, options: &Options) {
    if !options.quiet {
        say(&format!("{}: {}", scene.label(), scene.file.title));
        scene.grouping().iter().chain(&scene.mass_lines()).chain(&scene.wave_lines()).for_each(|line| say(line));
        if let Some(cost) = scene.cost() {
            say(&cost);
        }
    }
}

fn tell(finished: &Finished) {
    say(&finished.summary.text());
    if let Some(folder) = &finished.folder {
        say(&format!("written to {}", folder.display()));
    }
}

#[cfg(feature = "hdf5")]
fn render(args: &RenderArgs) -> Result<i32, Stop> {
    use crate::output;
    let refuse = Stop::Refused;
    let file = if args.file.is_dir() { args.file.join("particles.vtkhdf") } else { args.file.clone() };
    let times = output::vtkhdf::read(&file).map_err(refuse)?;
    let steps: Vec<usize> = match args.step {
        Some(k) if k >= times.len() => {
            return Err(Stop::Refused(format!(
                "{} holds {} steps, counted from 0; there is no step {k}",
                file.display(),
                times.len()
            )));
        }
        Some(k) => vec![k],
        None => (0..times.len()).collect(),
    };
    let beside = file.parent().unwrap_or(Path::new("."));
    let field = args.field.clone().unwrap_or_else(|| "velocity.magnitude".into());
    let folder = args.out.clone().unwrap_or_else(|| beside.join(format!("frames-{field}")));
    let place = |k: usize| folder.join(format!("{k:05}.png"));
    if let Some(there) = steps.iter().map(|&k| place(k)).find(|path| !args.force && path.exists()) {
        return Err(Stop::Refused(format!(
            "{} exists already; --force overwrites it, --out names another folder",
            there.display()
        )));
    }
    // What lies in the folder of a run is told to its manifest, so that a run that is forced takes it away too.
    let inside = folder.strip_prefix(beside).ok().map(|inside| inside.display().to_string());
    let mut manifest = output::manifest::Manifest::open(beside).ok().flatten().zip(inside);
    let painter = output::Painter::choose(args.gpu).map_err(refuse)?;
    let mut view = output::View {
        width: args.width,
        height: args.height,
        field,
        range: args.range.as_ref().map(|r| [r[0], r[1]]),
        eye: args.eye.as_ref().map(|e| [e[0], e[1], e[2]]),
        caption: beside.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
        ..output::View::default()
    };
    let mut first = None;
    for k in steps {
        let snapshot = output::vtkhdf::read_step(&file, k).map_err(refuse)?;
        // The first frame's box serves all, so that a sequence does not jump, but for what leaves it.
        let first = *first.get_or_insert_with(|| snapshot.bounds());
        view.bounds = Some(output::follow(first, &snapshot));
        let picture = painter.paint(&snapshot, &view).map_err(refuse)?;
        std::fs::create_dir_all(&folder).map_err(|e| Stop::Refused(format!("cannot write {}: {e}", folder.display())))?;
        let bytes = output::png(&picture).map_err(Stop::Failed)?;
        match &mut manifest {
            Some((manifest, inside)) => manifest.put(&format!("{inside}/{k:05}.png"), &[&bytes]),
            None => output::durable::put(&place(k), &[&bytes]),
        }
        .map_err(Stop::Failed)?;
    }
    say(&format!("pictures written to {}", folder.display()));
    Ok(0)
}

#[cfg(not(feature = "hdf5"))]
fn render(_: &RenderArgs) -> Result<i32, Stop> {
    Err(Stop::Refused("this build has no HDF5, so it cannot read stored particles".into()))
}

fn list(path: Option<&Path>) -> Result<i32, Stop> {
    if let Some(path) = path {
        for variant in scene::read::variants(path).map_err(Stop::Refused)? {
            say(&variant);
        }
        return Ok(0);
    }
    say("smoothing kernels");
    for kernel in smoothing::Smoothing::ALL {
        say(&format!("  {:<24} {}", kernel.word(), kernel.about()));
    }
    for role in material::Role::ALL {
        say(&format!("material laws: {}", role.word()));
        for law in material::Law::of_role(role) {
            say(&format!("  {:<24} {}", law.word(), law.about()));
            for number in law.declaration().numbers {
                let default = number.default.map_or_else(String::new, |value| format!("; {value} unless given"));
                let unit = material::unit_words(number.dimensions);
                say(&format!("    {:<22} {} [{unit}]{default}", number.key, number.about));
            }
        }
    }
    say("contact potentials");
    for potential in contact::Potential::ALL {
        say(&format!("  {:<24} {}", potential.name(), potential.about()));
    }
    say("other laws of contact");
    for (word, about) in contact::OTHERS {
        say(&format!("  {word:<24} {about}"));
    }
    say("obstacles");
    for kind in crate::obstacle::ObstacleKind::ALL {
        say(&format!("  {:<24} {}", kind.name(), kind.about()));
    }
    say("observables");
    for kind in observable::KINDS {
        say(&format!("  {:<24} {}", kind.word, kind.about));
    }
    say("passes");
    for pass in pass::Pass::ALL {
        say(&format!("  {:<24} {}", pass.name(), pass.about()));
    }
    for &set in fields::Set::ALL {
        say(&format!("fields of {}", set.word()));
        for field in fields::Field::ALL.iter().filter(|field| field.set() == set) {
            say(&format!("  {:<24} {}", field.name(), field.about()));
        }
    }
    Ok(0)
}

fn devices() -> Result<i32, Stop> {
    let list = crate::backend::device::list();
    for device in &list {
        let yes = |on: bool, word: &'static str| if on { word } else { "" };
        say(&format!(
            "{}, {} ({} {}), {}{}{}, largest table {} MiB",
            device.name,
            device.backend,
            device.driver,
            device.driver_info,
            device.kind,
            yes(device.f64, ", f64"),
            yes(device.timestamps, ", timestamps"),
            device.max_binding_bytes >> 20,
        ));
    }
    say(&format!("CPU, {} threads: the reference path, f64", rayon::current_num_threads()));
    if list.is_empty() {
        say("no Vulkan adapter: runs use the CPU");
    }
    Ok(0)
}
