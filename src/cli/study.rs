//! `lithosph study`: its words.

mod ablate;
mod cost;

use super::say;
use crate::backend::Choice;
use crate::run::Stop;
use crate::scene::Scene;
use crate::study::accuracy::{self, Cost, Kind, Request};
use crate::study::tensile::{self, Part};
use crate::study::{atlas, buckling, stability, sweep};
use clap::{Args, Subcommand, ValueEnum};
use std::io::IsTerminal as _;
use std::path::PathBuf;

#[derive(Debug, Subcommand)]
pub(super) enum Study {
    /// Run a scene over a matrix of settings; chart the error of each run against its cost, with the Pareto front.
    ///
    /// Writes a CSV with a row for each run, and beside it an SVG, a PNG and a page for a browser. The matrix is the
    /// product of all --vary, else that of the scene's table or tables `[study.accuracy]`, else of some resolutions,
    /// integrators and Courant numbers, and of kernels, smoothing lengths and stabilisations one at a time. The same
    /// command goes on where a kill left it.
    Accuracy(AccuracyArgs),
    /// Find the cheapest setting of a study that reaches an error; run the study where it is not finished.
    ///
    /// Prints the command that runs it, and the lines of a variant. Exit code 1 where no setting reaches the error.
    Recommend(RecommendArgs),
    /// Run a scene over a matrix of settings; write what it finds, a row for each setting, into a CSV.
    ///
    /// The same command goes on where a kill left it.
    Sweep(SweepArgs),
    /// Load at which the flawless scene, followed through its load steps, buckles; and how it does.
    Buckling(BucklingArgs),
    /// Growth rates of plane waves on the scene's lattice, in theory and in runs; the longest steps of the integrators.
    ///
    /// The first body is taken for an infinite square lattice in its uniform state: `relative_volume` and
    /// `deviatoric_stress` of an Eulerian body, `[study.stability]` of a Total Lagrangian one. Runs that a kill left out
    /// are made up for by the same command.
    Stability(StabilityArgs),
    /// The tensile instability: the repulsive force, bond viscosity and partitions of unity against chapter 5 of Strand 2010.
    ///
    /// Says for each of its figures whether it comes out; runs that are done are kept.
    Tensile(TensileArgs),
    /// Run the atlas of known failures: the plain method fails, its remedy survives; write a table and a page.
    ///
    /// The same command goes on where a kill left it. Exit code 1 if a row does not behave as stated.
    Atlas(AtlasArgs),
    /// What scenes pay for: fields, passes, dispatches, shader text, bytes a particle and time a step, a row each.
    ///
    /// Each scene is also composed from its own laws, kernel, files, fields and passes alone, and the table tells
    /// whether that gives the same fields, dispatches and WGSL, byte for byte.
    Cost(cost::CostArgs),
    /// Take a scene apart: run it without each piece of physics and numerics, coarser, shorter, of a dimension or a body
    /// less; tell what each changes and saves, and put together the smallest model within tolerance.
    ///
    /// A piece may go where all that the scene expects stays within its tolerances, or with --error within that fraction
    /// of the truth. The same command goes on where a kill left it.
    Ablate(ablate::AblateArgs),
}

#[derive(Debug, Args)]
pub(super) struct StabilityArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// An axis of the matrix: `--vary formulation.smoothing_length=1.2,1.3,1.5`. May be given several times.
    #[arg(long, value_name = "PATH=V1,V2")]
    vary: Vec<String>,
    /// Particles along each axis of the periodic box whose waves are looked at.
    #[arg(long, default_value_t = 48)]
    cells: usize,
    /// Waves of each setting to run beside theory.
    #[arg(long, value_name = "WAVES", default_value_t = 0)]
    simulate: usize,
    /// Also find the integrators' longest steps, from runs too.
    #[arg(long)]
    limits: bool,
    /// The table of settings; out/study/SCENE[-VARIANT]-stability.csv unless given. The rest lies beside it.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Begin anew and overwrite the runs.
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Args)]
pub(super) struct TensileArgs {
    /// Parts to do; all unless given.
    #[arg(value_enum)]
    parts: Vec<Part>,
    /// Folder of the page, tables and pictures.
    #[arg(long, default_value = "out/study/tensile")]
    out: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct AtlasArgs {
    /// Rows to run; all unless given.
    #[arg(value_name = "ROW")]
    rows: Vec<String>,
    /// Folder of atlas.csv, atlas.html and atlas/ with the runs and their pictures.
    #[arg(long, value_name = "FOLDER", default_value = "out/study")]
    out: PathBuf,
    /// Run rows anew that the table holds already.
    #[arg(long)]
    force: bool,
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
    /// An axis of the matrix: `--vary formulation.smoothing_length=1.2,1.3,1.5`, or `--vary variant=none,fine` over the
    /// scene's variants. May be given several times.
    #[arg(long, value_name = "PATH=V1,V2")]
    vary: Vec<String>,
    /// Where each setting runs, one or more.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "cpu")]
    backend_list: Vec<PlaceWord>,
    /// Judge settings by the error of this expectation; by that of the first with a reference unless given, else of the
    /// first that is relative, else by the largest over its tolerance.
    #[arg(long, value_name = "NAME")]
    observable: Option<String>,
    /// Which of its errors settings are judged by: its own norm unless given.
    #[arg(long, value_enum)]
    kind: Option<Kind>,
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

#[derive(Debug, Args)]
pub(super) struct RecommendArgs {
    #[command(flatten)]
    study: AccuracyArgs,
    /// As `1%` or `0.01`.
    #[arg(long, value_parser = accuracy::parse_error)]
    error: f64,
    /// What the setting shall be cheapest by.
    #[arg(long, value_enum, default_value = "cpu-seconds")]
    cost: Cost,
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
        Study::Recommend(args) => recommend(args),
        Study::Sweep(args) => swept(args),
        Study::Buckling(args) => buckling(args),
        Study::Stability(args) => stable(args),
        Study::Tensile(args) => tensile(args),
        Study::Atlas(args) => atlas_of_failures(args),
        Study::Cost(args) => cost::cost(args),
        Study::Ablate(args) => ablate::ablate(args),
    }
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

fn atlas_of_failures(args: &AtlasArgs) -> Result<i32, Stop> {
    let request = atlas::Request { rows: args.rows.clone(), out: args.out.clone(), force: args.force };
    let (text, as_stated) = atlas::run(&request)?;
    say(&format!("{text}\npage written to {}", args.out.join("atlas.html").display()));
    Ok(i32::from(!as_stated))
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

fn stable(args: &StabilityArgs) -> Result<i32, Stop> {
    let request = stability::Request {
        scene: args.scene.clone(),
        variant: args.variant.clone(),
        set: args.set.clone(),
        vary: args.vary.clone(),
        cells: args.cells,
        simulate: args.simulate,
        limits: args.limits,
        out: args.out.clone(),
        force: args.force,
    };
    say(&stability::run(&request)?);
    Ok(0)
}

fn tensile(args: &TensileArgs) -> Result<i32, Stop> {
    let request = tensile::Request { parts: args.parts.clone(), out: args.out.clone() };
    say(&tensile::study(&request, &|what| {
        if std::io::stderr().is_terminal() {
            eprintln!("{what}");
        }
    })?);
    Ok(0)
}

fn accuracy(args: &AccuracyArgs) -> Result<i32, Stop> {
    let study = planned(args)?;
    say(&study.announcement());
    say(&study.run()?);
    Ok(0)
}

fn recommend(args: &RecommendArgs) -> Result<i32, Stop> {
    say(&planned(&args.study)?.recommend(args.error, args.cost)?);
    Ok(0)
}

fn planned(args: &AccuracyArgs) -> Result<accuracy::Study, Stop> {
    let mut places = args.backend_list.clone();
    places.sort_unstable();
    places.dedup();
    let request = Request {
        scene: args.scene.clone(),
        variant: args.variant.clone(),
        vary: args.vary.clone(),
        backends: places.into_iter().map(PlaceWord::choice).collect(),
        observable: args.observable.clone(),
        kind: args.kind,
        repeats: args.repeats,
        out: args.out.clone(),
        force: args.force,
    };
    accuracy::Study::plan(&request).map_err(Stop::Refused)
}
