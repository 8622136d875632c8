//! Words of `lithosph study buckling`.

use super::refuse_existing;
use crate::cli::say::say;
use crate::run::Stop;
use crate::scene::Scene;
use crate::study::buckling;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct BucklingArgs {
    scene: PathBuf,
    #[arg(long)]
    variant: Option<String>,
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Table of the buckling mode; out/study/SCENE[-VARIANT]-buckling.csv unless given.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Overwrite the table.
    #[arg(long)]
    force: bool,
}

pub fn buckling(args: &BucklingArgs) -> Result<i32, Stop> {
    let scene = Scene::open_flawless(&args.scene, args.variant.as_deref(), &args.set).map_err(Stop::Refused)?;
    let usual = || PathBuf::from(format!("out/study/{}-buckling.csv", scene.label()));
    let path = args.out.clone().unwrap_or_else(usual);
    refuse_existing(&path, args.force)?;
    let found = buckling::find(&scene).map_err(Stop::Failed)?;
    buckling::write_mode(&scene, &found, &path).map_err(Stop::Failed)?;
    say(&format!("{}mode written to {}", found.text(), path.display()));
    Ok(0)
}
