//! Words of `lithosph study accuracy` and of `lithosph study recommend`.

use super::place::PlaceWord;
use crate::cli::say::say;
use crate::run::Stop;
use crate::study::accuracy::{self, Cost, ErrorKind, Request};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct AccuracyArgs {
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
    kind: Option<ErrorKind>,
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
pub struct RecommendArgs {
    #[command(flatten)]
    study: AccuracyArgs,
    /// As `1%` or `0.01`.
    #[arg(long, value_parser = accuracy::parse_error)]
    error: f64,
    /// What the setting shall be cheapest by.
    #[arg(long, value_enum, default_value = "cpu-seconds")]
    cost: Cost,
}

pub fn accuracy(args: &AccuracyArgs) -> Result<i32, Stop> {
    let study = planned(args)?;
    say(&study.announcement());
    say(&study.run()?);
    Ok(0)
}

pub fn recommend(args: &RecommendArgs) -> Result<i32, Stop> {
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
