//! Words of `lithosph study sweep`.

use super::place::PlaceWord;
use crate::cli::say::say;
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
        choice: args.backend.choice(),
        out: args.out.clone(),
    };
    let text = sweep::run(&request, |row| eprintln!("{row}"))?;
    say(&text);
    Ok(0)
}
