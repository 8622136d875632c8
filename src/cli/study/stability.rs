//! Words of `lithosph study stability`.

use crate::cli::say::say;
use crate::run::Stop;
use crate::study::stability;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct StabilityArgs {
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

pub fn stability(args: &StabilityArgs) -> Result<i32, Stop> {
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
