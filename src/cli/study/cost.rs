//! Words of `lithosph study cost`.

use super::place::PlaceWord;
use super::refuse_existing;
use crate::cli::say::say;
use crate::complain::complain;
use crate::run::Stop;
use crate::study::cost;
use clap::Args;
use std::io::IsTerminal as _;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct CostArgs {
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
    /// The CSV; out/study/cost.csv unless given. A chart and a page lie beside it.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Overwrite the CSV, and what lies beside it.
    #[arg(long)]
    force: bool,
}

pub fn cost(args: &CostArgs) -> Result<i32, Stop> {
    if args.show {
        for scene in &args.scenes {
            say(&cost::show(scene, args.variant.as_deref(), &args.set)?);
        }
        return Ok(0);
    }
    refuse_existing(&args.out.clone().unwrap_or_else(|| "out/study/cost.csv".into()), args.force)?;
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
            complain(&format!("{}: {} particles", row.scene, row.particles));
        }
    };
    let (text, holds) = cost::run(&request, tell)?;
    say(&text);
    Ok(i32::from(!holds))
}
