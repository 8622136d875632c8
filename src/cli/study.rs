//! `lithosph study`: its words.

use super::say;
use crate::backend::Choice;
use crate::run::Stop;
use crate::scene::Scene;
use crate::study::accuracy::{self, Request};
use crate::study::{ablate, buckling, cost, sweep};
use clap::{Args, Subcommand, ValueEnum};
use std::io::IsTerminal;
use std::path::PathBuf;

#[derive(Debug, Subcommand)]
pub(super) enum Study {
    /// Run a scene over a matrix of settings; write the error and the cost of each run as a row of a CSV.
    ///
    /// The matrix is the product of all --vary, else that of the scene's table `[study.accuracy]`, else of some
    /// smoothing lengths, integrators and Courant numbers. The same command goes on where a kill left it.
    Accuracy(AccuracyArgs),
    /// Run a scene over a matrix of settings; write what it finds, a row for each setting, into a CSV.
    ///
    /// The same command goes on where a kill left it.
    Sweep(SweepArgs),
    /// Load at which the flawless scene, followed through its load steps, buckles; and how it does.
    Buckling(BucklingArgs),
    /// What scenes pay for: fields, passes, dispatches, shader text, bytes a particle and time a step, a row each.
    ///
    /// Each scene is also composed from its own laws, kernel, files, fields and passes alone, and the table tells
    /// whether that gives the same fields, dispatches and WGSL, byte for byte.
    Cost(CostArgs),
    /// Take a scene apart: run it without each piece of physics and numerics, coarser, shorter, of a dimension or a body
    /// less; tell what each changes and saves, and put together the smallest model within tolerance.
    ///
    /// A piece may go where all that the scene expects stays within its tolerances, or with --error within that fraction
    /// of the truth. The same command goes on where a kill left it.
    Ablate(AblateArgs),
}

#[derive(Debug, Args)]
pub(super) struct AblateArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    /// Overrides of the scene before it is taken apart.
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Error allowed in place of the scene's tolerances: `1%` or `0.01`.
    #[arg(long, value_parser = fraction)]
    error: Option<f64>,
    #[arg(long, value_enum, default_value = "cpu")]
    backend: PlaceWord,
    /// Runs of the scene and of each piece; the cheapest counts.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeats: u32,
    /// The CSV; out/study/SCENE[-VARIANT]-ablate.csv unless given.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Begin anew and overwrite the CSV.
    #[arg(long)]
    force: bool,
}

/// A positive fraction, typed as such or in percent.
fn fraction(text: &str) -> Result<f64, String> {
    let (digits, scale) = text.strip_suffix('%').map_or((text, 1.0), |digits| (digits, 0.01));
    let number = digits.trim().parse::<f64>().map(|number| scale * number);
    number.ok().filter(|number| *number > 0.0 && number.is_finite()).ok_or_else(|| "must be like `1%` or `0.01`".into())
}

#[derive(Debug, Args)]
pub(super) struct CostArgs {
    /// All of the folder `scenes` unless given.
    scenes: Vec<PathBuf>,
    #[arg(long)]
    variant: Option<String>,
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    #[arg(long, value_enum, default_value = "cpu")]
    backend: PlaceWord,
    /// Time steps of scenes of more than 300,000 particles too.
    #[arg(long)]
    all: bool,
    /// Print fields, dispatches and WGSL of the scenes instead.
    #[arg(long, requires = "scenes")]
    show: bool,
    /// The CSV; out/study/cost.csv unless given.
    #[arg(long)]
    out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct BucklingArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Table of the buckling mode; out/study/SCENE[-VARIANT]-buckling.csv unless given.
    #[arg(long)]
    out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct SweepArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    /// An axis of the matrix: `--vary contact.0.gap.friction=0,0.2,0.4`. May be given several times.
    #[arg(long, value_name = "PATH=V1,V2")]
    vary: Vec<String>,
    #[arg(long, value_enum, default_value = "cpu")]
    backend: PlaceWord,
    /// The CSV; out/study/SCENE[-VARIANT]-sweep.csv unless given.
    #[arg(long)]
    out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct AccuracyArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    /// An axis of the matrix: `--vary formulation.smoothing_length=1.2,1.3,1.5`. May be given several times.
    #[arg(long, value_name = "PATH=V1,V2")]
    vary: Vec<String>,
    /// Where each setting runs, one or more.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "cpu")]
    backend_list: Vec<PlaceWord>,
    /// Measure the error of this expectation alone; of all with a value or a reference unless given.
    #[arg(long, value_name = "NAME")]
    observable: Option<String>,
    /// Runs of each setting, each a row; the table at the end keeps the cheapest.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeats: u32,
    /// The CSV; out/study/SCENE[-VARIANT]-accuracy.csv unless given.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Begin anew and overwrite the CSV.
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
enum PlaceWord {
    /// The CPU path in f64.
    Cpu,
    /// The CPU path in f32.
    Cpu32,
    /// Any adapter, a software one too.
    Gpu,
}

impl PlaceWord {
    fn choice(self) -> Choice {
        match self {
            Self::Cpu => Choice::Cpu,
            Self::Cpu32 => Choice::Cpu32,
            Self::Gpu => Choice::Gpu(None),
        }
    }
}

/// Does a study; gives the exit code.
pub(super) fn study(study: &Study) -> Result<i32, Stop> {
    match study {
        Study::Accuracy(args) => accuracy(args),
        Study::Sweep(args) => swept(args),
        Study::Buckling(args) => buckling(args),
        Study::Cost(args) => costs(args),
        Study::Ablate(args) => ablated(args),
    }
}

fn ablated(args: &AblateArgs) -> Result<i32, Stop> {
    let request = ablate::Request {
        scene: args.scene.clone(),
        variant: args.variant.clone(),
        set: args.set.clone(),
        choice: args.backend.choice(),
        error: args.error,
        repeats: args.repeats,
        out: args.out.clone(),
        force: args.force,
    };
    let study = ablate::Study::plan(&request).map_err(Stop::Refused)?;
    say(&study.announcement());
    let visible = std::io::stderr().is_terminal();
    let tell = |line: &str| {
        if visible {
            eprintln!("{line}");
        }
    };
    let found = study.run(tell)?;
    say(&study.report(&found).map_err(Stop::Failed)?);
    Ok(0)
}

fn costs(args: &CostArgs) -> Result<i32, Stop> {
    if args.show {
        for scene in &args.scenes {
            say(&cost::show(scene, args.variant.as_deref(), &args.set)?);
        }
        return Ok(0);
    }
    let request = cost::Request {
        scenes: args.scenes.clone(),
        variant: args.variant.clone(),
        set: args.set.clone(),
        choice: args.backend.choice(),
        all: args.all,
        out: args.out.clone(),
    };
    let visible = std::io::stderr().is_terminal();
    let tell = |row: &cost::Row| {
        if visible {
            eprintln!("{}: {} particles", row.scene, row.particles);
        }
    };
    let (text, holds) = cost::run(&request, tell)?;
    say(&text);
    Ok(i32::from(!holds))
}

fn swept(args: &SweepArgs) -> Result<i32, Stop> {
    let request = sweep::Request {
        scene: args.scene.clone(),
        variant: args.variant.clone(),
        vary: args.vary.clone(),
        choice: args.backend.choice(),
        out: args.out.clone(),
    };
    let text = sweep::run(&request, |row| eprintln!("{row}"))?;
    say(&text);
    Ok(0)
}

fn buckling(args: &BucklingArgs) -> Result<i32, Stop> {
    let scene = Scene::open_flawless(&args.scene, args.variant.as_deref(), &args.set).map_err(Stop::Refused)?;
    let found = buckling::find(&scene).map_err(Stop::Failed)?;
    let usual = || PathBuf::from(format!("out/study/{}-buckling.csv", scene.label()));
    let path = args.out.clone().unwrap_or_else(usual);
    buckling::write_mode(&scene, &found, &path).map_err(Stop::Failed)?;
    say(&format!("{}mode written to {}", found.text(), path.display()));
    Ok(0)
}

fn accuracy(args: &AccuracyArgs) -> Result<i32, Stop> {
    let mut places = args.backend_list.clone();
    places.sort_unstable();
    places.dedup();
    let request = Request {
        scene: args.scene.clone(),
        variant: args.variant.clone(),
        vary: args.vary.clone(),
        backends: places.into_iter().map(PlaceWord::choice).collect(),
        observable: args.observable.clone(),
        repeats: args.repeats,
        out: args.out.clone(),
        force: args.force,
    };
    let study = accuracy::Study::plan(&request).map_err(Stop::Refused)?;
    say(&study.announcement());
    say(&study.run()?);
    Ok(0)
}
