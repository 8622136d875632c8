//! Words of `lithosph study atlas`.

use crate::cli::say::say;
use crate::run::Stop;
use crate::study::atlas;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct AtlasArgs {
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

pub fn atlas(args: &AtlasArgs) -> Result<i32, Stop> {
    let request = atlas::Request { rows: args.rows.clone(), out: args.out.clone(), force: args.force };
    let (text, as_stated) = atlas::run(&request)?;
    say(&format!("{text}\npage written to {}", args.out.join("atlas.html").display()));
    Ok(i32::from(!as_stated))
}
