//! Words of `lithosph study ablate`.

use super::place::PlaceWord;
use crate::cli::say::say;
use crate::complain::complain;
use crate::run::Stop;
use crate::study::ablate;
use crate::study::accuracy::parse_error;
use clap::Args;
use std::io::IsTerminal as _;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct AblateArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    /// Overrides of the scene before it is taken apart.
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Error allowed in place of the scene's tolerances: `1%` or `0.01`.
    #[arg(long, value_parser = parse_error)]
    error: Option<f64>,
    #[arg(long, value_enum, default_value = "cpu")]
    backend: PlaceWord,
    /// Runs of the scene and of each piece; the cheapest counts.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeats: u32,
    /// The CSV; out/study/SCENE[-VARIANT]-ablate.csv unless given. Pictures and a page lie beside it.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Begin anew and overwrite the CSV.
    #[arg(long)]
    force: bool,
}

pub fn ablate(args: &AblateArgs) -> Result<i32, Stop> {
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
            complain(line);
        }
    };
    let found = study.run(tell)?;
    say(&study.report(&found).map_err(Stop::Failed)?);
    Ok(0)
}
