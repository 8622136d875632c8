//! `lithosph study`: its words.

mod ablate;
mod accuracy;
mod atlas;
mod buckling;
mod cost;
mod place;
mod stability;
mod sweep;
mod tensile;

use crate::run::Stop;
use clap::Subcommand;
use std::path::Path;

#[derive(Debug, Subcommand)]
pub(super) enum Study {
    /// Run a scene over a matrix of settings; chart the error of each run against its cost, with the Pareto front.
    ///
    /// Writes a CSV with a row for each run, and beside it an SVG, a PNG and a page for a browser. The matrix is the
    /// product of all --vary, else that of the scene's table or tables `[study.accuracy]`, else of some resolutions,
    /// integrators and Courant numbers, and of kernels, smoothing lengths and stabilisations one at a time. The same
    /// command goes on where a kill left it.
    Accuracy(accuracy::AccuracyArgs),
    /// Find the cheapest setting of a study that reaches an error; run the study where it is not finished.
    ///
    /// Prints the command that runs it, and the lines of a variant. Exit code 1 where no setting reaches the error.
    Recommend(accuracy::RecommendArgs),
    /// Run a scene over a matrix of settings; write what it finds, a row for each setting, into a CSV.
    ///
    /// The same command goes on where a kill left it.
    Sweep(sweep::SweepArgs),
    /// Load at which the flawless scene, followed through its load steps, buckles; and how it does.
    Buckling(buckling::BucklingArgs),
    /// Growth rates of plane waves on the scene's lattice, in theory and in runs; the longest steps of the integrators.
    ///
    /// The first body is taken for an infinite square lattice in its uniform state: `relative_volume` and
    /// `deviatoric_stress` of an Eulerian body, `[study.stability]` of a Total Lagrangian one. Runs that a kill left out
    /// are made up for by the same command.
    Stability(stability::StabilityArgs),
    /// The tensile instability: the repulsive force, bond viscosity and partitions of unity against chapter 5 of Strand 2010.
    ///
    /// Says for each of its figures whether it comes out; runs that are done are kept.
    Tensile(tensile::TensileArgs),
    /// Run the atlas of known failures: the plain method fails, its remedy survives; write a table and a page.
    ///
    /// The same command goes on where a kill left it. Exit code 1 if a row does not behave as stated.
    Atlas(atlas::AtlasArgs),
    /// What scenes pay for: fields, passes, dispatches, shader text, bytes a particle and time a step, a row each.
    ///
    /// Each scene is also composed from its own laws, kernel, files, fields and passes alone, and the table tells
    /// whether that gives the same fields, dispatches and WGSL, byte for byte.
    Cost(cost::CostArgs),
    /// Take a scene apart: run it without each piece of physics and numerics, coarser, shorter, of a dimension or a body
    /// less; tell what each changes and saves, and put together the smallest model within tolerance.
    ///
    /// A piece may go where all that the scene expects stays within its tolerances, or with --error within that fraction
    /// of the truth. The same command goes on where a kill left it.
    Ablate(ablate::AblateArgs),
}

/// Does a study; gives the exit code.
pub(super) fn study(study: &Study) -> Result<i32, Stop> {
    match study {
        Study::Accuracy(args) => accuracy::accuracy(args),
        Study::Recommend(args) => accuracy::recommend(args),
        Study::Sweep(args) => sweep::sweep(args),
        Study::Buckling(args) => buckling::buckling(args),
        Study::Stability(args) => stability::stability(args),
        Study::Tensile(args) => tensile::tensile(args),
        Study::Atlas(args) => atlas::atlas(args),
        Study::Cost(args) => cost::cost(args),
        Study::Ablate(args) => ablate::ablate(args),
    }
}

/// Refuses to overwrite a table unless forced: before the study, which may take hours.
fn refuse_existing(path: &Path, force: bool) -> Result<(), Stop> {
    if path.exists() && !force {
        return Err(Stop::Refused(format!("{} exists already; --force overwrites it, --out names another file", path.display())));
    }
    Ok(())
}
