//! Words of `lithosph study tensile`.

use crate::cli::say::say;
use crate::complain::complain;
use crate::run::Stop;
use crate::study::tensile::{self, Part};
use clap::Args;
use std::io::IsTerminal as _;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct TensileArgs {
    /// Parts to do; all unless given.
    #[arg(value_enum)]
    parts: Vec<Part>,
    /// Folder of the page, tables and pictures.
    #[arg(long, default_value = "out/study/tensile")]
    out: PathBuf,
}

pub fn tensile(args: &TensileArgs) -> Result<i32, Stop> {
    let request = tensile::Request { parts: args.parts.clone(), out: args.out.clone() };
    say(&tensile::study(&request, &|what| {
        if std::io::stderr().is_terminal() {
            complain(what);
        }
    })?);
    Ok(0)
}
