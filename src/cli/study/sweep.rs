//! Words of `lithosph study sweep`.

use super::place::PlaceWord;
use crate::cli::say::say;
use crate::complain::complain;
use crate::run::Stop;
use crate::study::sweep;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct SweepArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    /// An axis of the matrix: `--vary contact.0.gap.friction=0,0.2,0.4`. May be given several times.
    #[arg(long, value_name = "PATH=V1,V2")]
    vary: Vec<String>,
    /// A number to take of each run: a result, or a statistic of a series, such as `tip.max` (first, final, min, max, mean or
    /// drift). May be given several times; all results unless given, or of a scene that finds none final, min and max of each
    /// series.
    #[arg(long, value_name = "OBSERVABLE[.STATISTIC]")]
    number: Vec<String>,
    #[arg(long, value_enum, default_value = "cpu")]
    backend: PlaceWord,
    /// The CSV; out/study/SCENE[-VARIANT]-sweep.csv unless given.
    #[arg(long)]
    out: Option<PathBuf>,
}

pub fn sweep(args: &SweepArgs) -> Result<i32, Stop> {
    let request = sweep::Request {
        scene: args.scene.clone(),
        variant: args.variant.clone(),
        vary: args.vary.clone(),
        numbers: args.number.clone(),
        choice: args.backend.choice(),
        out: args.out.clone(),
    };
    let text = sweep::run(&request, complain)?;
    say(&text);
    Ok(0)
}
