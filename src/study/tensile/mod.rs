//! The tensile instability and what chapter 5 of Strand 2010 tries against it: the repulsive force (artificial stress), the
//! work that it does, its use in compression, bond viscosity, two partitions of unity, and the edge of a linear function.
//! Everything comes from the program's kernels and equations; the published numbers are in `published`.

mod case;
mod compression;
mod criteria;
mod draw;
mod edge;
mod findings;
mod line;
mod particles;
mod partition;
mod plane;
mod points;
mod published;
mod repulsion;
mod runs;
mod sweeps;
mod tension;
mod unity;
mod viscosity;
mod windows;
mod work;

#[cfg(test)]
mod tests;

pub use case::{Case, Form, Law, Spacing};
pub use findings::{Exhibit, Findings, Statement};
pub use particles::{Block, Row, Rule};

use crate::run::Stop;
use crate::study::chart::{Page, Section};
use findings::listed;
use std::path::{Path, PathBuf};

/// A part of the study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Part {
    /// The repulsive force over both meanings of dp, epsilon, n, h and tension, by von Neumann's analysis.
    Repulsion,
    /// Swegle's test by simulation.
    Runs,
    /// Work of the repulsive force.
    Work,
    /// The repulsive force in compression.
    Compression,
    /// Bond viscosity.
    Viscosity,
    /// Estimates of unity, and both criteria of a partition of unity.
    Partition,
    /// The edge of a linear function.
    Edge,
}

impl Part {
    pub const ALL: [Self; 7] =
        [Self::Repulsion, Self::Runs, Self::Work, Self::Compression, Self::Viscosity, Self::Partition, Self::Edge];

    fn word(self) -> &'static str {
        match self {
            Self::Repulsion => "repulsion",
            Self::Runs => "runs",
            Self::Work => "work",
            Self::Compression => "compression",
            Self::Viscosity => "viscosity",
            Self::Partition => "partition",
            Self::Edge => "edge",
        }
    }

    /// Does it; `folder` keeps what takes long.
    ///
    /// # Errors
    /// A run of the program that fails, or the user.
    pub fn find(self, folder: &Path, tell: &dyn Fn(&str)) -> Result<Findings, Stop> {
        let joined = |parts: Vec<Findings>| {
            parts.into_iter().fold(Findings::default(), |mut all, part| {
                all.add(part);
                all
            })
        };
        Ok(match self {
            Self::Repulsion => joined(vec![
                repulsion::spacing(),
                repulsion::epsilon(),
                sweeps::exponent(),
                sweeps::smoothing_length(),
                tension::tension(),
            ]),
            Self::Runs => runs::runs(&folder.join("runs"), tell)?,
            Self::Work => work::work(),
            Self::Compression => compression::compression(),
            Self::Viscosity => viscosity::viscosity()?,
            Self::Partition => joined(vec![unity::lattices(), criteria::criteria()]),
            Self::Edge => edge::linear(),
        })
    }
}

/// What the command line asks.
#[derive(Debug, Clone)]
pub struct Request {
    /// All where it is empty.
    pub parts: Vec<Part>,
    /// Folder of all files.
    pub out: PathBuf,
}

/// Does the parts, writes their files and the page `tensile.html`; gives the statements as text.
///
/// # Errors
/// A folder or file that cannot be written, a run that fails, or the user.
pub fn study(request: &Request, tell: &dyn Fn(&str)) -> Result<String, Stop> {
    let folder = &request.out;
    std::fs::create_dir_all(folder).map_err(|error| Stop::Refused(format!("{}: {error}", folder.display())))?;
    let parts = if request.parts.is_empty() { Part::ALL.to_vec() } else { request.parts.clone() };
    let mut all = Findings::default();
    for part in parts {
        tell(part.word());
        all.add(part.find(folder, tell)?);
    }
    let table = listed(&all.statements);
    findings::write_csv(&table, &folder.join("statements.csv")).map_err(Stop::Failed)?;
    for exhibit in &all.exhibits {
        exhibit.write(folder).map_err(Stop::Failed)?;
    }
    let agree = all.statements.iter().filter(|statement| statement.agrees).count();
    let lead = format!(
        "Chapter 5 of Strand 2010 redone: {agree} of {} statements agree. Swegle's test: a block under uniform tension, whose \
         border is held and whose middle particle is kicked. Rates are in c/dx, the speed of sound over the spacing.",
        all.statements.len()
    );
    let text = format!("{}{lead}\nwritten to {}", lines(&all.statements), folder.join("tensile.html").display());
    let verdicts = Section { heading: "Where it agrees and where not".into(), table: Some(table), ..Section::default() };
    let sections = std::iter::once(verdicts).chain(all.exhibits.into_iter().map(Exhibit::section)).collect();
    let page = Page { title: "The tensile instability and its remedies".into(), lead, sections };
    page.write(&folder.join("tensile.html")).map_err(Stop::Failed)?;
    Ok(text)
}

fn lines(statements: &[Statement]) -> String {
    let line = |s: &Statement| format!("{}  {}: {} | here: {}\n", s.verdict(), s.place, s.published, s.found);
    statements.iter().map(line).collect()
}
